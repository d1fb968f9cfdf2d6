// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/transform.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tyndall {
namespace {

constexpr Matrix4 identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

Matrix4 multiply(const Matrix4& a, const Matrix4& b) {
  Matrix4 c{};
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j)
      for (size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

// Floats are what is traced with in the end.
bool is_float(const Matrix4& m) {
  constexpr double largest = std::numeric_limits<float>::max();
  for (const auto& row : m)
    for (const double x : row)
      if (!(std::abs(x) <= largest)) return false;
  return true;
}

// The size of a row without its translation, which may be larger by many orders.
double row_scale(const std::array<double, 4>& row) {
  const double linear = std::max({std::abs(row[0]), std::abs(row[1]), std::abs(row[2])});
  return linear > 0 ? linear : 1;
}

// Gauss-Jordan elimination with partial pivoting. Rows are brought to
// one size first, so that a pivot of nothing but rounding can be told from a small one.
std::optional<Matrix4> invert(const Matrix4& m) {
  std::array<std::array<double, 8>, 4> a{};
  for (size_t i = 0; i < 4; ++i) {
    const double scale = 1 / row_scale(m[i]);
    for (size_t j = 0; j < 4; ++j) a[i][j] = m[i][j] * scale;
    a[i][4 + i] = scale;
  }
  for (size_t column = 0; column < 4; ++column) {
    size_t pivot = column;
    for (size_t i = column + 1; i < 4; ++i)
      if (std::abs(a[i][column]) > std::abs(a[pivot][column])) pivot = i;
    if (!(std::abs(a[pivot][column]) > 1e-14)) return std::nullopt;
    std::swap(a[pivot], a[column]);
    const double inv = 1 / a[column][column];
    for (double& x : a[column]) x *= inv;
    for (size_t i = 0; i < 4; ++i) {
      if (i == column) continue;
      const double factor = a[i][column];
      for (size_t j = 0; j < 8; ++j) a[i][j] -= factor * a[column][j];
    }
  }
  Matrix4 inverse{};
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j) inverse[i][j] = a[i][4 + j];
  if (!is_float(inverse)) return std::nullopt;
  return inverse;
}

}  // namespace

Transform::Transform() : m_(identity), inv_(identity) {}

std::optional<Transform> Transform::from_matrix(const Matrix4& m) {
  if (!is_float(m)) return std::nullopt;
  const std::optional<Matrix4> inv = invert(m);
  if (!inv) return std::nullopt;
  return Transform(m, *inv);
}

Transform Transform::translate(Vec3d by) {
  Matrix4 m = identity, inv = identity;
  m[0][3] = by.x, m[1][3] = by.y, m[2][3] = by.z;
  for (size_t i = 0; i < 3; ++i) inv[i][3] = -m[i][3];
  return {m, inv};
}

Transform Transform::scale(Vec3d by) {
  assert(by.x != 0 && by.y != 0 && by.z != 0);
  Matrix4 m = identity, inv = identity;
  m[0][0] = by.x, m[1][1] = by.y, m[2][2] = by.z;
  for (size_t i = 0; i < 3; ++i) inv[i][i] = 1 / m[i][i];
  return {m, inv};
}

Transform Transform::rotate(double angle, Vec3d axis) {
  const Vec3d a = axis * (1 / length(axis));
  const double turn = angle * (std::numbers::pi / 180);
  const double s = std::sin(turn), c = std::cos(turn);
  Matrix4 m = identity, inv = identity;
  m[0] = {a.x * a.x + (1 - a.x * a.x) * c, a.x * a.y * (1 - c) - a.z * s,
          a.x * a.z * (1 - c) + a.y * s, 0};
  m[1] = {a.x * a.y * (1 - c) + a.z * s, a.y * a.y + (1 - a.y * a.y) * c,
          a.y * a.z * (1 - c) - a.x * s, 0};
  m[2] = {a.x * a.z * (1 - c) - a.y * s, a.y * a.z * (1 - c) + a.x * s,
          a.z * a.z + (1 - a.z * a.z) * c, 0};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) inv[j][i] = m[i][j];
  return {m, inv};
}

std::optional<Transform> Transform::look_at(Vec3d eye, Vec3d at, Vec3d up) {
  const Vec3d forward = at - eye;
  const Vec3d right = cross(up, forward);
  if (!(length(right) > 0)) return std::nullopt;
  const Vec3d z = forward * (1 / length(forward));
  const Vec3d x = right * (1 / length(right));
  const Vec3d y = cross(z, x);
  const std::optional<Transform> world_from_camera = from_matrix({{{x.x, y.x, z.x, eye.x},
                                                                   {x.y, y.y, z.y, eye.y},
                                                                   {x.z, y.z, z.z, eye.z},
                                                                   {0, 0, 0, 1}}});
  if (!world_from_camera) return std::nullopt;
  return world_from_camera->inverse();
}

Vec3d Transform::precise_point(Vec3d p) const {
  const auto row = [&](size_t i) {
    return m_[i][0] * p.x + m_[i][1] * p.y + m_[i][2] * p.z + m_[i][3];
  };
  const Vec3d q{row(0), row(1), row(2)};
  const double w = row(3);
  return w == 1 ? q : q * (1 / w);
}

Vec3 Transform::vector(Vec3 v) const {
  const Vec3d d = v;
  const auto row = [&](size_t i) {
    return m_[i][0] * d.x + m_[i][1] * d.y + m_[i][2] * d.z;
  };
  return to_float({row(0), row(1), row(2)});
}

Vec3 Transform::normal(Vec3 n) const {
  const Vec3d d = n;
  const auto column = [&](size_t j) {
    return inv_[0][j] * d.x + inv_[1][j] * d.y + inv_[2][j] * d.z;
  };
  return to_float({column(0), column(1), column(2)});
}

Bounds3 Transform::bounds(const Bounds3& b) const {
  Bounds3 result;
  if (b.is_empty()) return result;
  for (int i = 0; i < 8; ++i) result.extend(point(b.corner(i)));
  return result;
}

Transform Transform::inverse() const { return {inv_, m_}; }

Transform Transform::operator*(const Transform& b) const {
  return {multiply(m_, b.m_), multiply(b.inv_, inv_)};
}

bool Transform::fits_in_floats() const { return is_float(m_) && is_float(inv_); }

bool Transform::swaps_handedness() const {
  const Vec3 x = vector({1, 0, 0}), y = vector({0, 1, 0}), z = vector({0, 0, 1});
  return dot(cross(x, y), z) < 0;
}

}  // namespace tyndall
