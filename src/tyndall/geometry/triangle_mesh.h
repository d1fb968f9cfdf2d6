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
  /// Whether the geometric normal of point() is opposite to triangle(primitive).normal(),
  /// which is `n`.
  bool turns_outside(uint32_t primitive, Vec2 barycentric, Vec3d n) const;
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
  // Between the values at the corners of a triangle.
  template <typename T>
  T interpolate(uint32_t primitive, Vec2 b, const std::vector<T>& values) const {
    const Vec3i& t = triangles_[primitive];
    return values[static_cast<size_t>(t.x)] * (1 - b.x - b.y) +
           values[static_cast<size_t>(t.y)] * b.x + values[static_cast<size_t>(t.z)] * b.y;
  }

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
  Vec3 ng = to_float(normalize_or_z(triangle.normal()));
  Vec3 ns = flip_normals_ ? -ng : ng;
  if (!normals_.empty()) {
    const Vec3 n = interpolate(primitive, barycentric, normals_);
    if (length_squared(n) > 0) ns = normalize(n);
  }
  if (dot(ng, ns) < 0) ng = -ng;
  // Without texture coordinates pbrt gives the corners these.
  const Vec2 uv = uvs_.empty() ? Vec2{barycentric.x + barycentric.y, barycentric.y}
                               : interpolate(primitive, barycentric, uvs_);
  return {.p = to_float(triangle.position(barycentric)), .ng = ng, .ns = ns, .uv = uv};
}

inline bool TriangleMesh::turns_outside(uint32_t primitive, Vec2 barycentric,
                                        Vec3d n) const {
  if (normals_.empty()) return flip_normals_;
  const Vec3 ns = interpolate(primitive, barycentric, normals_);
  return length_squared(ns) > 0 ? dot(to_float(n), ns) < 0 : flip_normals_;
}

}  // namespace tyndall
