// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/transform.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

constexpr Matrix4 identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

Matrix4 multiply(const Matrix4& a, const Matrix4& b) {
  Matrix4 c{};
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j) {
      double sum = 0;
      for (size_t k = 0; k < 4; ++k) sum += double{a[i][k]} * double{b[k][j]};
      c[i][j] = static_cast<float>(sum);
    }
  return c;
}

// The size of a row without its translation, which may be larger by many orders.
double row_scale(const std::array<float, 4>& row) {
  const float linear = std::max({std::abs(row[0]), std::abs(row[1]), std::abs(row[2])});
  return double{linear > 0 ? linear : 1.0f};
}

// Gauss-Jordan elimination with partial pivoting, in double precision. Rows are brought to
// one size first, so that a pivot of nothing but rounding can be told from a small one.
std::optional<Matrix4> invert(const Matrix4& m) {
  std::array<std::array<double, 8>, 4> a{};
  for (size_t i = 0; i < 4; ++i) {
    const double scale = 1 / row_scale(m[i]);
    for (size_t j = 0; j < 4; ++j) a[i][j] = double{m[i][j]} * scale;
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
    for (size_t j = 0; j < 4; ++j) {
      inverse[i][j] = static_cast<float>(a[i][4 + j]);
      if (!std::isfinite(inverse[i][j])) return std::nullopt;
    }
  return inverse;
}

}  // namespace

Transform::Transform() : m_(identity), inv_(identity) {}

std::optional<Transform> Transform::from_matrix(const Matrix4& m) {
  for (const auto& row : m)
    for (const float x : row)
      if (!std::isfinite(x)) return std::nullopt;
  const std::optional<Matrix4> inv = invert(m);
  if (!inv) return std::nullopt;
  return Transform(m, *inv);
}

Transform Transform::translate(Vec3 by) {
  Matrix4 m = identity, inv = identity;
  for (int i = 0; i < 3; ++i) {
    m[static_cast<size_t>(i)][3] = by[i];
    inv[static_cast<size_t>(i)][3] = -by[i];
  }
  return {m, inv};
}

Transform Transform::scale(Vec3 by) {
  assert(by.x != 0 && by.y != 0 && by.z != 0);
  Matrix4 m = identity, inv = identity;
  for (int i = 0; i < 3; ++i) {
    m[static_cast<size_t>(i)][static_cast<size_t>(i)] = by[i];
    inv[static_cast<size_t>(i)][static_cast<size_t>(i)] = 1 / by[i];
  }
  return {m, inv};
}

Transform Transform::rotate(float angle, Vec3 axis) {
  const Vec3 a = normalize(axis);
  const float s = std::sin(radians(angle)), c = std::cos(radians(angle));
  Matrix4 m = identity, inv = identity;
  const Vec3 rows[3] = {{a.x * a.x + (1 - a.x * a.x) * c, a.x * a.y * (1 - c) - a.z * s,
                         a.x * a.z * (1 - c) + a.y * s},
                        {a.x * a.y * (1 - c) + a.z * s, a.y * a.y + (1 - a.y * a.y) * c,
                         a.y * a.z * (1 - c) - a.x * s},
                        {a.x * a.z * (1 - c) - a.y * s, a.y * a.z * (1 - c) + a.x * s,
                         a.z * a.z + (1 - a.z * a.z) * c}};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      m[i][j] = rows[i][static_cast<int>(j)];
      inv[j][i] = m[i][j];
    }
  return {m, inv};
}

std::optional<Transform> Transform::look_at(Vec3 eye, Vec3 at, Vec3 up) {
  const Vec3 forward = at - eye;
  const Vec3 right = cross(up, forward);
  if (!(length_squared(right) > 0)) return std::nullopt;
  const Vec3 z = normalize(forward);
  const Vec3 x = normalize(right);
  const Vec3 y = cross(z, x);
  Matrix4 m = identity;  // world_from_camera
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<size_t>(i);
    m[row] = {x[i], y[i], z[i], eye[i]};
  }
  const std::optional<Transform> world_from_camera = from_matrix(m);
  if (!world_from_camera) return std::nullopt;
  return world_from_camera->inverse();
}

Vec3 Transform::point(Vec3 p) const {
  const auto row = [&](size_t i) {
    return m_[i][0] * p.x + m_[i][1] * p.y + m_[i][2] * p.z + m_[i][3];
  };
  const Vec3 q{row(0), row(1), row(2)};
  const float w = row(3);
  return w == 1 ? q : q / w;
}

Vec3 Transform::vector(Vec3 v) const {
  const auto row = [&](size_t i) {
    return m_[i][0] * v.x + m_[i][1] * v.y + m_[i][2] * v.z;
  };
  return {row(0), row(1), row(2)};
}

Vec3 Transform::normal(Vec3 n) const {
  const auto column = [&](size_t j) {
    return inv_[0][j] * n.x + inv_[1][j] * n.y + inv_[2][j] * n.z;
  };
  return {column(0), column(1), column(2)};
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

bool Transform::swaps_handedness() const {
  const Vec3 x = vector({1, 0, 0}), y = vector({0, 1, 0}), z = vector({0, 0, 1});
  return dot(cross(x, y), z) < 0;
}

}  // namespace tyndall
