// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/light_square.h"

#include <algorithm>
#include <cmath>

#include "tyndall/math/constants.h"
#include "tyndall/math/elementary.h"

namespace tyndall {

namespace {

// Single-precision unit vectors do not resolve smaller angles.
constexpr float least_sine = 1e-7f;
constexpr float inv_pi3 = inv_pi * inv_pi * inv_pi;

/// A point of the unit disk; `inner` = 1 - radius^2 without cancellation near the rim.
struct DiskPoint {
  float radius, inner;
  float cos_phi = 1, sin_phi = 0;
};

DiskPoint disk_from_square(Vec2 p) {
  const float a = 2 * p.x - 1, b = 2 * p.y - 1;
  const float edge = 2 * std::min({p.x, 1 - p.x, p.y, 1 - p.y});  // 1 - radius, exact
  const float radius = 1 - edge;
  const float inner = std::max(edge * (1 + radius), 0.0f);
  if (a == 0 && b == 0) return {0, 1};
  const bool is_wide = std::abs(a) > std::abs(b);
  const float turn = 0.25f * pi * (is_wide ? b / a : a / b), square = sqr(turn);
  const float major = std::copysign(cosine_by_square(square), is_wide ? a : b);
  const float minor = std::copysign(turn * sine_over(square), is_wide ? b : a);
  return is_wide ? DiskPoint{radius, inner, major, minor}
                 : DiskPoint{radius, inner, minor, major};
}

// `edge` is 1 - radius.
Vec2 square_from_disk(float radius, float edge, float x, float y) {
  const float sector = 4 * inv_pi;
  Vec2 p;
  if (std::abs(x) > std::abs(y)) {
    const float minor = 0.5f * radius * arc_tangent(y / x) * sector;
    p = x > 0 ? Vec2{1 - 0.5f * edge, 0.5f + minor} : Vec2{0.5f * edge, 0.5f - minor};
  } else if (y != 0) {
    const float minor = 0.5f * radius * arc_tangent(x / y) * sector;
    p = y > 0 ? Vec2{0.5f + minor, 1 - 0.5f * edge} : Vec2{0.5f - minor, 0.5f * edge};
  } else {
    p = {0.5f + 0.5f * radius, 0.5f};
  }
  return {std::clamp(p.x, 0.0f, 1.0f), std::clamp(p.y, 0.0f, 1.0f)};
}

// (pi - theta) / (pi^3 sin theta) by the angle `back` = pi - theta.
float joint_density(float back, float sine) {
  return inv_pi3 * (back < 1e-3f ? 1 : back / std::max(sine, least_sine));
}

}  // namespace

SquareDirection LightSquare::direction(Vec2 p) const {
  const DiskPoint disk = disk_from_square(p);
  const float root = std::sqrt(disk.inner);
  float sine, cosine, density;
  if (measure_ == SquareMeasure::solid_angle) {
    sine = 2 * disk.radius * root;
    cosine = 2 * disk.inner - 1;
    density = inv_4pi;
  } else {
    // radius^2 = 1 - (1 - theta / pi)^2; each branch takes the angle that is exact there.
    const float back = pi * root;
    const float theta = pi * sqr(disk.radius) / (1 + root);
    const float acute = std::min(theta, back), square = sqr(acute);
    sine = acute * sine_over(square);
    cosine = std::copysign(cosine_by_square(square), back - theta);
    density = joint_density(back, sine);
  }
  return {frame_.to_world({sine * disk.cos_phi, sine * disk.sin_phi, cosine}), density};
}

SquarePoint LightSquare::point(Vec3 w) const {
  const Vec3 v = frame_.to_local(w);
  const float sine = std::sqrt(v.x * v.x + v.y * v.y);
  float squared_radius, inner, density;
  if (measure_ == SquareMeasure::solid_angle) {
    // sin^2 / (1 +- cos) is the smaller of 1 -+ cos without cancellation.
    const float small = 0.5f * sqr(sine) / (1 + std::abs(v.z));
    squared_radius = v.z > 0 ? small : 1 - small;
    inner = v.z > 0 ? 1 - small : small;
    density = inv_4pi;
  } else {
    const PolarAngle angle = polar_angle(v.z, sine);
    inner = sqr(angle.back * inv_pi);
    squared_radius = angle.theta * inv_pi * (1 + angle.back * inv_pi);
    density = joint_density(angle.back, sine);
  }
  const float radius = std::sqrt(std::clamp(squared_radius, 0.0f, 1.0f));
  return {square_from_disk(radius, inner / (1 + radius), v.x, v.y), density};
}

float LightSquare::density(Vec3 w) const {
  if (measure_ == SquareMeasure::solid_angle) return inv_4pi;
  const Vec3 v = frame_.to_local(w);
  const float sine = std::sqrt(v.x * v.x + v.y * v.y);
  return joint_density(polar_angle(v.z, sine).back, sine);
}

Frame turned_frame(const Frame& reference, Vec3 axis) {
  // Rodrigues: x' = x - (x . axis) / (1 + z . axis) (z + axis), and alike for y.
  const float denominator = 1 + dot(reference.z, axis);
  if (denominator < 1e-4f) return Frame::from_z(axis);
  const Vec3 bisector = (reference.z + axis) * (1 / denominator);
  const Vec3 x = normalize(reference.x - bisector * dot(reference.x, axis));
  return {x, cross(axis, x), axis};
}

}  // namespace tyndall
