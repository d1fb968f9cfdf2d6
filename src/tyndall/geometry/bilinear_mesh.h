// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tyndall/geometry/area_table.h"
#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/math/bounds.h"

namespace tyndall {

/// The surface (1-v) ((1-u) p00 + u p10) + v ((1-u) p01 + u p11) over the unit square.
struct BilinearPatch {
  Vec3d p00, p10, p01, p11;

  Vec3d position(double u, double v) const;
  /// The cross product of the derivatives by u and v: the normal, as long as the area per
  /// unit of (u, v).
  Vec3d normal(double u, double v) const;
  bool is_parallelogram() const;
  double area() const;
};

/// Bilinear patches with shared vertices in world space; corners (0,0) (1,0) (0,1) (1,1).
///
/// The outside is where the cross product of the derivatives by u and v points, turned by
/// `flip_normals`. Where normals are given they decide instead, as in pbrt-v4.
class BilinearMesh {
 public:
  /// Arguments as those of TriangleMesh.
  BilinearMesh(std::vector<Vec3> positions, std::vector<std::array<int, 4>> patches,
               std::vector<Vec3> normals, std::vector<Vec2> uvs, bool flip_normals);

  const std::vector<Vec3>& positions() const { return positions_; }
  const std::vector<std::array<int, 4>>& patches() const { return patches_; }

  SurfacePoint point(uint32_t primitive, Vec2 uv) const;
  BilinearPatch patch(uint32_t primitive) const;
  Bounds3 bounds() const;
  float area() const { return static_cast<float>(areas_.total()); }
  ShapeSample sample(Vec2 u) const;  ///< uniform by area
  float pdf_area(const SurfacePoint& on) const;

 private:
  std::vector<Vec3> positions_;
  std::vector<std::array<int, 4>> patches_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> uvs_;
  bool flip_normals_;
  AreaTable areas_;
};

}  // namespace tyndall
