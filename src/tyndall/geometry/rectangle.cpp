// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/rectangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tyndall/math/constants.h"

namespace tyndall {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double least_solid_angle = 1e-6;

// The inner angle at the corner (x, y, z) of the spherical rectangle whose other corners
// lie towards smaller |x| and |y| if `sign` is negative: between the planes through the
// viewer and the two edges. By the arc tangent, as the arc cosine loses half the digits of
// flat angles.
double inner_angle(double x, double y, double z, double sign) {
  return std::atan2(-z * std::hypot(x, y, z), sign * x * y);
}

}  // namespace

bool Rectangle::is_proper() const {
  const double xx = dot(edge_x, edge_x), yy = dot(edge_y, edge_y);
  return xx > 0 && yy > 0 && std::abs(dot(edge_x, edge_y)) <= 1e-5 * std::sqrt(xx * yy);
}

std::optional<SphericalRectangle> SphericalRectangle::seen_from(
    Vec3 from, const Rectangle& rectangle) {
  const double length_x = length(rectangle.edge_x), length_y = length(rectangle.edge_y);
  const Vec3d x = rectangle.edge_x * (1 / length_x), y = rectangle.edge_y * (1 / length_y);
  const Vec3d to_corner = rectangle.corner - Vec3d(from);
  SphericalRectangle seen;
  seen.z_ = -std::abs(dot(to_corner, cross(x, y)));
  seen.x0_ = dot(to_corner, x);
  seen.y0_ = dot(to_corner, y);
  seen.x1_ = seen.x0_ + length_x;
  seen.y1_ = seen.y0_ + length_y;
  const double near_angles = inner_angle(seen.x1_, seen.y0_, seen.z_, 1) +
                             inner_angle(seen.x1_, seen.y1_, seen.z_, -1);
  seen.far_angles_ = two_pi - inner_angle(seen.x0_, seen.y1_, seen.z_, 1) -
                     inner_angle(seen.x0_, seen.y0_, seen.z_, -1);
  // The excess of the sum of the inner angles.
  seen.solid_angle_ = near_angles - seen.far_angles_;
  if (!(seen.solid_angle_ > least_solid_angle) ||
      !(seen.z_ < -1e-9 * (length_x + length_y)))
    return std::nullopt;
  return seen;
}

Vec2 SphericalRectangle::sample(Vec2 u) const {
  // The part of the rectangle with x below x_u has the solid angle u times the whole if the
  // plane through the viewer and the line x = x_u makes the angle below with the edge y =
  // y0.
  const double b0 = -y0_ / std::hypot(y0_, z_), b1 = y1_ / std::hypot(y1_, z_);
  const double angle = static_cast<double>(u.x) * solid_angle_ + far_angles_;
  const double f = (std::cos(angle) * b0 - b1) / std::sin(angle);
  const double c = std::clamp(std::copysign(1.0, f) / std::hypot(f, b0), -1.0, 1.0);
  const double x = std::clamp(-c * z_ / std::sqrt(std::max(1 - c * c, 1e-300)), x0_, x1_);
  // On that line the height above the viewer's equator is uniform.
  const double d = std::hypot(x, z_);
  const double h = std::lerp(y0_ / std::hypot(d, y0_), y1_ / std::hypot(d, y1_),
                             static_cast<double>(u.y));
  const double y = std::clamp(h * d / std::sqrt(std::max(1 - h * h, 1e-300)), y0_, y1_);
  return {static_cast<float>((x - x0_) / (x1_ - x0_)),
          static_cast<float>((y - y0_) / (y1_ - y0_))};
}

}  // namespace tyndall
