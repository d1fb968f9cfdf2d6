// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"

namespace tyndall {

/// pbrt's (partial) sphere about the origin of its own space; its outside is away from the
/// center, turned by `flip_normals`. A transform that is not a rotation, translation and
/// scale makes it an ellipsoid.
struct Sphere {
  Transform world_from_sphere;
  float radius;
  float z_min, z_max;  ///< clips, in sphere space; in either order, cut off at the radius
  float phi_max;       ///< [rad]
  bool flip_normals;

  /// `uv` as in pbrt: the azimuth as part of phi_max, and the polar angle between the
  /// clips.
  SurfacePoint point(uint32_t primitive, Vec2 uv) const;
  /// The point whose normal in sphere space is the unit vector `n`.
  SurfacePoint point_at(Vec3d n) const;
  /// The `uv` of point_at(n).
  Vec2 parameters(Vec3d n) const;
  Bounds3 bounds() const;
  float area() const;
  /// Uniform by area, or if stretched, uniform over the sphere before it is.
  ShapeSample sample(Vec2 u) const;
  float pdf_area(const SurfacePoint& on) const;

  /// Of a whole sphere, uniform in all directions if seen from inside, and uniform in the
  /// cone that it fills if seen from outside; else by area.
  /// Empty if nothing can be seen.
  std::optional<ShapeDirectionSample> sample_direction(Vec3 from, Vec2 u) const;
  float direction_pdf(Vec3 from, const SurfacePoint& on) const;

  bool is_full() const;  ///< no clip takes anything away
};

}  // namespace tyndall
