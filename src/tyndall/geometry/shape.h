// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "tyndall/geometry/bilinear_mesh.h"
#include "tyndall/geometry/disk.h"
#include "tyndall/geometry/sphere.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/geometry/triangle_mesh.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// The closed set of shapes. Degenerate ones (no primitives, no area, no radius) are never
/// hit and never sampled.
using Shape = std::variant<TriangleMesh, Sphere, Disk, BilinearMesh>;

/// What an intersector finds: enough to reconstruct the point.
struct ShapeHit {
  float t;             ///< distance along the ray [scene units]
  uint32_t primitive;  ///< triangle or patch
  Vec2 uv;             ///< barycentric (b1, b2), or the shape's own parameters
};

/// The point of a hit, in the shape's world space. `p` lies on the shape as exactly as
/// float allows, which t alone does not give.
SurfacePoint surface_point(const Shape& shape, uint32_t primitive, Vec2 uv);
Bounds3 bounds(const Shape& shape);
float area(const Shape& shape);
/// A point uniform by area (on an ellipsoid: uniform before it is stretched).
ShapeSample sample_area(const Shape& shape, Vec2 u);
/// A point by its direction from `from`: uniform in solid angle where a closed form is
/// known (spheres from outside), else by area. Empty if nothing can be seen from there.
std::optional<ShapeDirectionSample> sample_direction(const Shape& shape, Vec3 from, Vec2 u);
/// Density of sample_direction() for the point `on` of the shape [1/sr]; zero where the
/// shape is sampled by area and seen edge-on, which it never returns.
float direction_pdf(const Shape& shape, Vec3 from, const SurfacePoint& on);

}  // namespace tyndall
