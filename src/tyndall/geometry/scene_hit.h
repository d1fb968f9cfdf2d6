// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/geometry/target_shape.h"

namespace tyndall {

/// A hit, in world space.
struct SceneHit {
  float t;         ///< distance along the ray [scene units]
  uint32_t group;  ///< group and shape index as given to the intersector
  uint32_t shape;
  SurfacePoint point;
};

/// Where a ray goes through a boundary: what its media depend on.
struct Crossing {
  float t;         ///< distance along the ray [scene units]
  uint32_t group;  ///< group and shape index as given to the intersector
  uint32_t shape;
  bool goes_out;  ///< to the side of the geometric normal
};

/// Where an instance of a group of shapes is.
struct InstanceMaps {
  uint32_t group;
  Affine world_from_group, group_from_world;

  PreciseRay group_ray(const PreciseRay& ray_world) const {
    return {.o = group_from_world.point(ray_world.o),
            .d = group_from_world.vector(ray_world.d)};
  }
};

/// What a ray meets and how far away: enough to decide whether to go there.
struct RayHit {
  float t;         ///< distance along the ray [scene units]
  uint32_t group;  ///< group and shape index as given to the intersector
  uint32_t shape;
  uint32_t primitive, instance;  ///< as the intersector counts them
  Vec2 uv;                       ///< barycentric, of triangles
};

/// The hit to double precision, rounded once. `ray` is in the space of the target, whose
/// instance is null in the world.
SceneHit reconstruct(const TargetShape& target, const RayHit& hit, const PreciseRay& ray,
                     const InstanceMaps* instance);

/// The crossing at a hit of a boundary, by a ray as in reconstruct(); `world_d` is its
/// direction in the world.
Crossing crossing_at(const TargetShape& target, const RayHit& hit, const PreciseRay& ray,
                     const InstanceMaps* instance, Vec3 world_d);

}  // namespace tyndall
