// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/math/constants.h"
#include "tyndall/math/elementary.h"
#include "tyndall/math/vec.h"

/// Maps of uniform numbers in [0, 1) to densities on disks, spheres and lines. Each comes
/// as sample, pdf and invert; invert(sample(u)) is u up to rounding.

namespace tyndall {

/// 1 - w.z of a unit vector without cancellation near the pole.
inline float one_minus_cos(Vec3 w) {
  return w.z > 0 ? (sqr(w.x) + sqr(w.y)) / (1 + w.z) : 1 - w.z;
}

/// The azimuth of (x, y) as a number in [0, 1).
inline float azimuth_to_unit(float x, float y) {
  const float turns = polar_angle(x, magnitude(y)).theta * (0.5f * inv_pi);
  return std::min(y < 0 ? 1 - turns : turns, one_minus_epsilon);
}

/// A point of the unit disk, uniform by area; squares around the centre become circles
/// [Shirley97].
inline Vec2 sample_concentric_disk(Vec2 u) {
  const float x = 2 * u.x - 1, y = 2 * u.y - 1;
  if (x == 0 && y == 0) return {};
  const bool x_major = magnitude(x) > magnitude(y);
  const float major = x_major ? x : y, minor = x_major ? y : x;
  const float phi = pi / 4 * (minor / major), square = phi * phi;
  const float c = major * cosine_by_square(square), s = major * phi * sine_over(square);
  return x_major ? Vec2{c, s} : Vec2{s, c};
}
constexpr float concentric_disk_pdf() { return inv_pi; }
inline Vec2 invert_concentric_disk(Vec2 p) {
  const bool x_major = magnitude(p.x) > magnitude(p.y);
  const float major = x_major ? p.x : p.y, minor = x_major ? p.y : p.x;
  if (major == 0) return {0.5f, 0.5f};
  const float radius = std::copysign(std::sqrt(dot(p, p)), major);
  const float other = radius * arc_tangent(minor / major) * (4 / pi);
  const auto to_unit = [](float a) {
    return std::clamp(0.5f * (a + 1), 0.0f, one_minus_epsilon);
  };
  return x_major ? Vec2{to_unit(radius), to_unit(other)}
                 : Vec2{to_unit(other), to_unit(radius)};
}

/// A direction around +z in proportion to its cosine; never exactly on the horizon, so that
/// the density is positive.
inline Vec3 sample_cosine_hemisphere(Vec2 u) {
  const Vec2 d = sample_concentric_disk(u);
  return {d.x, d.y, std::max(safe_sqrt(1 - dot(d, d)), 1e-4f)};
}
constexpr float cosine_hemisphere_pdf(float cos_theta) {
  return cos_theta > 0 ? cos_theta * inv_pi : 0;
}
inline Vec2 invert_cosine_hemisphere(Vec3 w) { return invert_concentric_disk({w.x, w.y}); }

/// A direction of the whole sphere, uniform.
inline Vec3 sample_uniform_sphere(Vec2 u) {
  return spherical_direction_of_turns(1 - 2 * u.x, u.y);
}
constexpr float uniform_sphere_pdf() { return inv_4pi; }
inline Vec2 invert_uniform_sphere(Vec3 w) {
  return {std::clamp(0.5f * (1 - w.z), 0.0f, one_minus_epsilon), azimuth_to_unit(w.x, w.y)};
}

/// A direction within the cone around +z whose half-angle has the cosine 1 -
/// `one_minus_cos_max`, uniform. The complement is asked for because the cosine itself is
/// too coarse for the narrow cones of far lights. Precondition: 0 < one_minus_cos_max <= 2.
inline Vec3 sample_uniform_cone(Vec2 u, float one_minus_cos_max) {
  const float h = u.x * one_minus_cos_max;
  const float sin_theta = safe_sqrt(h * (2 - h));
  const SineCosine phi = sine_cosine_of_turns(u.y);
  return {sin_theta * phi.cosine, sin_theta * phi.sine, 1 - h};
}
/// Within the cone; the caller knows whether a direction is.
constexpr float uniform_cone_pdf(float one_minus_cos_max) {
  return 1 / (2 * pi * one_minus_cos_max);
}
inline Vec2 invert_uniform_cone(Vec3 w, float one_minus_cos_max) {
  return {std::clamp(one_minus_cos(w) / one_minus_cos_max, 0.0f, one_minus_epsilon),
          azimuth_to_unit(w.x, w.y)};
}

/// A direction of the hemisphere around +z, uniform.
inline Vec3 sample_uniform_hemisphere(Vec2 u) { return sample_uniform_cone(u, 1); }
constexpr float uniform_hemisphere_pdf(float cos_theta) {
  return cos_theta >= 0 ? 0.5f * inv_pi : 0;
}
inline Vec2 invert_uniform_hemisphere(Vec3 w) { return invert_uniform_cone(w, 1); }

/// The barycentric weights of two corners of a triangle, for a point uniform by area: the
/// map with little distortion of [Heitz19]. The third weight is 1 - x - y.
constexpr Vec2 sample_uniform_triangle(Vec2 u) {
  return u.x < u.y ? Vec2{0.5f * u.x, u.y - 0.5f * u.x}
                   : Vec2{u.x - 0.5f * u.y, 0.5f * u.y};
}
/// Density w.r.t. the barycentric weights; divide it by twice the area for points.
constexpr float uniform_triangle_pdf() { return 2; }
constexpr Vec2 invert_uniform_triangle(Vec2 b) {
  return b.x < b.y ? Vec2{2 * b.x, b.x + b.y} : Vec2{b.x + b.y, 2 * b.y};
}

/// A distance in [0, t_max] in proportion to exp(-sigma t). Uniform where sigma t_max is
/// below the resolution of float. Preconditions: sigma >= 0, t_max > 0, and not both 0 and
/// infinite. The result can be infinite only if t_max is, for a sigma close to the smallest
/// float.
inline float sample_exponential(float u, float sigma, float t_max = infinity) {
  assert(sigma >= 0 && t_max > 0 && (sigma > 0 || t_max < infinity));
  const float depth = sigma * t_max;
  if (depth < 1e-7f) return u * t_max;
  return std::min(-std::log1p(u * std::expm1(-depth)) / sigma, t_max);
}
/// Density w.r.t. distance; zero outside [0, t_max].
inline float exponential_pdf(float t, float sigma, float t_max = infinity) {
  if (!(t >= 0 && t <= t_max)) return 0;
  const float depth = sigma * t_max;
  if (depth < 1e-7f) return 1 / t_max;
  return sigma * std::exp(-sigma * t) / -std::expm1(-depth);
}
inline float invert_exponential(float t, float sigma, float t_max = infinity) {
  const float depth = sigma * t_max;
  const float u = depth < 1e-7f ? t / t_max : std::expm1(-sigma * t) / std::expm1(-depth);
  return std::clamp(u, 0.0f, one_minus_epsilon);
}

}  // namespace tyndall
