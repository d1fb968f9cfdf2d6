// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/brick_grid.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// Uniform in [a, b).
inline float uniform(RandomStream& rng, float a, float b) {
  return a + (b - a) * rng.next_1d();
}

/// What a random grid is filled with.
enum class GridContent {
  uniform_noise,  ///< independent, in [0, 1)
  mostly_empty,   ///< one sample in 50 is positive
  dynamic_range,  ///< from 1e-12 to 1e6, log-uniform
  constant,       ///< one
};

DensityGrid random_grid(RandomStream& rng, Vec3i resolution, GridContent content);

/// The largest value.
float largest_value(const DensityGrid& grid);

/// What becomes of medium space in the world.
enum class Placement { identity, rotated, sheared, mirrored, tiny, huge, far_away };

inline constexpr Placement all_placements[] = {
    Placement::identity, Placement::rotated, Placement::sheared, Placement::mirrored,
    Placement::tiny,     Placement::huge,    Placement::far_away};

Transform random_transform(RandomStream& rng, Placement placement);

/// Where random rays start.
enum class RayStart { outside, inside, border, parallel_to_axis };

inline constexpr RayStart all_ray_starts[] = {RayStart::outside, RayStart::inside,
                                              RayStart::border, RayStart::parallel_to_axis};

/// A ray that meets the box `bounds` of medium space, in world space. Those parallel to an
/// axis are so in medium space, from outside.
Ray random_ray(RandomStream& rng, RayStart start, const Bounds3& bounds,
               const Transform& world_from_medium);

/// The interpolant as its definition says, at a point of the world.
double reference_density(const DensityGrid& grid, const Bounds3& bounds,
                         const Transform& world_from_medium, Vec3 p_world);

/// The exact integral of the interpolant along a ray of world space up to t_max.
double reference_optical_depth(const DensityGrid& grid, const Bounds3& bounds,
                               const Transform& world_from_medium, const Ray& ray,
                               double t_max);

}  // namespace tyndall
