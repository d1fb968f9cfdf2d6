// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tyndall/geometry/area_table.h"
#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/math/bounds.h"

namespace tyndall {

/// A corner of a triangle and the edges from there to the second and third, in double
/// precision.
struct PreciseTriangle {
  Vec3d p0, edge1, edge2;

  /// Twice the area long; on the side that sees the corners counterclockwise.
  Vec3d normal() const { return cross(edge1, edge2); }
  Vec3d position(Vec2 barycentric) const {
    return p0 + edge1 * static_cast<double>(barycentric.x) +
           edge2 * static_cast<double>(barycentric.y);
  }
};

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

  /// The point with barycentric coordinates (b1, b2) of the second and third corner.
  SurfacePoint point(uint32_t primitive, Vec2 barycentric) const {
    return point(primitive, barycentric, triangle(primitive));
  }
  /// The same if triangle(primitive) is known already.
  SurfacePoint point(uint32_t primitive, Vec2 barycentric,
                     const PreciseTriangle& triangle) const;
  PreciseTriangle triangle(uint32_t primitive) const {
    const Vec3i& t = triangles_[primitive];
    const Vec3d p0(positions_[static_cast<size_t>(t.x)]);
    return {.p0 = p0,
            .edge1 = Vec3d(positions_[static_cast<size_t>(t.y)]) - p0,
            .edge2 = Vec3d(positions_[static_cast<size_t>(t.z)]) - p0};
  }
  Bounds3 bounds() const;
  float area() const { return static_cast<float>(areas_.total()); }
  ShapeSample sample(Vec2 u) const;  ///< uniform by area
  float pdf_area(const SurfacePoint& on) const;

 private:
  std::vector<Vec3> positions_;
  std::vector<Vec3i> triangles_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> uvs_;
  bool flip_normals_;
  AreaTable areas_;
};

// Inline, as every ray that hits something comes by.
inline SurfacePoint TriangleMesh::point(uint32_t primitive, Vec2 barycentric,
                                        const PreciseTriangle& triangle) const {
  const Vec3i& t = triangles_[primitive];
  const auto interpolate = [&](const auto& a, const auto& b, const auto& c) {
    return a * (1 - barycentric.x - barycentric.y) + b * barycentric.x + c * barycentric.y;
  };
  const auto interpolate_vertices = [&](const auto& values) {
    return interpolate(values[static_cast<size_t>(t.x)], values[static_cast<size_t>(t.y)],
                       values[static_cast<size_t>(t.z)]);
  };
  Vec3 ng = to_float(normalize_or_z(triangle.normal()));
  Vec3 ns = flip_normals_ ? -ng : ng;
  if (!normals_.empty()) {
    const Vec3 n = interpolate_vertices(normals_);
    if (length_squared(n) > 0) ns = normalize(n);
  }
  if (dot(ng, ns) < 0) ng = -ng;
  // Without texture coordinates pbrt gives the corners these.
  const Vec2 uv = uvs_.empty() ? interpolate(Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1})
                               : interpolate_vertices(uvs_);
  return {.p = to_float(triangle.position(barycentric)), .ng = ng, .ns = ns, .uv = uv};
}

}  // namespace tyndall
