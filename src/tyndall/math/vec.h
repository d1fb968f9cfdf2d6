// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>

#include "tyndall/math/elementary.h"
#include "tyndall/math/scalar.h"

namespace tyndall {

struct Vec2 {
  float x = 0, y = 0;

  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.y * s}; }
constexpr Vec2 operator*(float s, Vec2 a) { return a * s; }
constexpr float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

struct Vec2i {
  int x = 0, y = 0;

  friend constexpr bool operator==(const Vec2i&, const Vec2i&) = default;
};

constexpr Vec2i operator+(Vec2i a, Vec2i b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2i operator-(Vec2i a, Vec2i b) { return {a.x - b.x, a.y - b.y}; }

struct Vec3i {
  int x = 0, y = 0, z = 0;

  friend constexpr bool operator==(const Vec3i&, const Vec3i&) = default;
};

/// Points, directions and normals alike; which one, and in which space, the name says.
struct Vec3 {
  float x = 0, y = 0, z = 0;

  constexpr float operator[](int i) const {
    assert(0 <= i && i < 3);
    return i == 0 ? x : i == 1 ? y : z;
  }
  constexpr float& operator[](int i) {
    assert(0 <= i && i < 3);
    return i == 0 ? x : i == 1 ? y : z;
  }
  constexpr Vec3 operator-() const { return {-x, -y, -z}; }
  constexpr Vec3& operator+=(Vec3 b) { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(Vec3 b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr Vec3& operator*=(float s) { return x *= s, y *= s, z *= s, *this; }

  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(float s, Vec3 a) { return a * s; }
constexpr Vec3 operator/(Vec3 a, float s) { return a * (1 / s); }

constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr float abs_dot(Vec3 a, Vec3 b) { return magnitude(dot(a, b)); }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr float length_squared(Vec3 a) { return dot(a, a); }
inline float length(Vec3 a) { return std::sqrt(length_squared(a)); }
constexpr float distance_squared(Vec3 a, Vec3 b) { return length_squared(a - b); }
inline float distance(Vec3 a, Vec3 b) { return length(a - b); }

/// Precondition: `a` is not zero.
inline Vec3 normalize(Vec3 a) { return a / length(a); }

constexpr Vec3 lerp(Vec3 a, Vec3 b, float t) { return a * (1 - t) + b * t; }
constexpr Vec3 min(Vec3 a, Vec3 b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
constexpr Vec3 max(Vec3 a, Vec3 b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
constexpr Vec3 abs(Vec3 a) { return {magnitude(a.x), magnitude(a.y), magnitude(a.z)}; }
constexpr float max_component(Vec3 a) { return std::max({a.x, a.y, a.z}); }
constexpr float min_component(Vec3 a) { return std::min({a.x, a.y, a.z}); }
inline bool is_finite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The unit vector at polar angle acos(cos_theta) from +z and azimuth `phi` [rad].
inline Vec3 spherical_direction(float cos_theta, float phi) {
  const float sin_theta = safe_sqrt(1 - sqr(cos_theta));
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}
/// The same at an azimuth of so many turns, in [0, 1]: for uniform numbers.
inline Vec3 spherical_direction_of_turns(float cos_theta, float turns) {
  const float sin_theta = safe_sqrt(1 - sqr(cos_theta));
  const SineCosine phi = sine_cosine_of_turns(turns);
  return {sin_theta * phi.cosine, sin_theta * phi.sine, cos_theta};
}

}  // namespace tyndall
