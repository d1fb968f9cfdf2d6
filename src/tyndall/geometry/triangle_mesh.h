// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tyndall/geometry/area_table.h"
#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/math/bounds.h"

namespace tyndall {

/// Triangles with shared vertices, positions in world space (or in its group's, if
/// instanced).
///
/// The outside of a triangle is the side that sees its corners counterclockwise in a
/// right-handed space, turned by `flip_normals`. Where normals are given they decide
/// instead, as in pbrt-v4.
class TriangleMesh {
 public:
  /// `normals` and `uvs` are empty or as many as `positions`; normals need not be unit.
  /// `flip_normals` turns the outside in (pbrt's ReverseOrientation xor a mirroring
  /// transform) but leaves `normals` alone: pbrt negates those by ReverseOrientation only,
  /// and so must the caller. Preconditions: indices in range. Triangles that are not finite
  /// are never hit.
  TriangleMesh(std::vector<Vec3> positions, std::vector<Vec3i> triangles,
               std::vector<Vec3> normals, std::vector<Vec2> uvs, bool flip_normals);

  const std::vector<Vec3>& positions() const { return positions_; }
  const std::vector<Vec3i>& triangles() const { return triangles_; }

  /// Of a point inside the triangle with barycentric coordinates (b1, b2) of its second and
  /// third corner.
  SurfacePoint point(uint32_t primitive, Vec2 barycentric) const;
  Vec3d position(uint32_t primitive, Vec2 barycentric) const;
  Bounds3 bounds() const;
  float area() const { return static_cast<float>(areas_.total()); }
  ShapeSample sample(Vec2 u) const;  ///< uniform by area
  float pdf_area(const SurfacePoint& on) const;

 private:
  Vec3d corner(uint32_t primitive, int i) const;
  // Twice the area long, before it is turned to the outside.
  Vec3d unnormalized_normal(uint32_t primitive) const;

  std::vector<Vec3> positions_;
  std::vector<Vec3i> triangles_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> uvs_;
  bool flip_normals_;
  AreaTable areas_;
};

}  // namespace tyndall
