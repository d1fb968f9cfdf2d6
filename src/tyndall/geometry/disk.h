// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"

namespace tyndall {

/// pbrt's (partial) annulus in the plane z = height of its own space; its outside is +z,
/// turned by `flip_normals`.
struct Disk {
  Transform world_from_disk;
  float height, radius, inner_radius;
  float phi_max;  ///< [rad]
  bool flip_normals;

  /// `uv` as in pbrt: the azimuth as part of phi_max, and 0 at the outer radius, 1 at the
  /// inner.
  SurfacePoint point(uint32_t primitive, Vec2 uv) const;
  Bounds3 bounds() const;
  float area() const;
  ShapeSample sample(Vec2 u) const;  ///< uniform by area
  float pdf_area(const SurfacePoint& on) const;
};

}  // namespace tyndall
