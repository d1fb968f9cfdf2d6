// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "tyndall/math/vec.h"

namespace tyndall {

/// A point, direction or normal in double precision: where something that is far from the
/// origin stands, and what lies between the float vertices of a shape and the float point
/// of a hit, so that the latter is off the shape by one rounding only.
struct Vec3d {
  double x = 0, y = 0, z = 0;

  constexpr Vec3d() = default;
  constexpr Vec3d(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  constexpr Vec3d(Vec3 v)  // NOLINT: nothing is lost
      : x(static_cast<double>(v.x)),
        y(static_cast<double>(v.y)),
        z(static_cast<double>(v.z)) {}

  constexpr Vec3d operator-() const { return {-x, -y, -z}; }

  // Friends, so that they do not compete for the braces in length({x, y, z}).
  friend constexpr Vec3d operator+(Vec3d a, Vec3d b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vec3d operator-(Vec3d a, Vec3d b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vec3d operator*(Vec3d a, double s) {
    return {a.x * s, a.y * s, a.z * s};
  }
  friend constexpr Vec3d operator*(double s, Vec3d a) { return a * s; }
  friend constexpr double dot(Vec3d a, Vec3d b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend constexpr Vec3d cross(Vec3d a, Vec3d b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend double length(Vec3d a) { return std::sqrt(dot(a, a)); }
  /// The sum of the components without their signs: a cheap bound of length().
  friend double taxicab_length(Vec3d a) {
    return std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
  }
};

/// Rounds each component to the nearest float.
constexpr Vec3 to_float(Vec3d a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

}  // namespace tyndall
