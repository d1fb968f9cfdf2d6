// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// A point on a shape with what shading needs to know of it.
struct SurfacePoint {
  Vec3 p;      ///< world space
  Vec3 ng;     ///< unit geometric normal; its side is the shape's outside
  Vec3 ns;     ///< unit shading normal, in the hemisphere of ng
  Vec2 uv;     ///< texture coordinates
};

/// A point drawn on a shape.
struct ShapeSample {
  SurfacePoint point;
  float pdf_area;  ///< density w.r.t. surface area [1/scene unit^2]
};

/// A point drawn on a shape as seen from elsewhere.
struct ShapeDirectionSample {
  SurfacePoint point;
  float pdf;  ///< density of the direction towards it w.r.t. solid angle [1/sr]
};

/// Triangles with shared vertices, positions in world space (or in its group's, if instanced).
class TriangleMesh {
 public:
  /// `normals` and `uvs` are empty or as many as `positions`. Preconditions: indices in range.
  /// `flip_normals` turns the outside in (pbrt's ReverseOrientation xor a mirroring transform).
  TriangleMesh(std::vector<Vec3> positions, std::vector<Vec3i> triangles,
               std::vector<Vec3> normals, std::vector<Vec2> uvs, bool flip_normals);

  const std::vector<Vec3>& positions() const { return positions_; }
  const std::vector<Vec3i>& triangles() const { return triangles_; }

  SurfacePoint point(uint32_t primitive, Vec2 barycentric) const;
  Bounds3 bounds() const;
  float area() const;
  ShapeSample sample(Vec2 u) const;  ///< uniform by area

 private:
  std::vector<Vec3> positions_;
  std::vector<Vec3i> triangles_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> uvs_;
  bool flip_normals_;
  std::vector<float> area_cdf_;  // inclusive sums of the triangles' areas
};

/// pbrt's (partial) sphere about the origin of its own space.
struct Sphere {
  Transform world_from_sphere;
  float radius;
  float z_min, z_max;  ///< clips, in sphere space
  float phi_max;       ///< [rad]
  bool flip_normals;
};

/// pbrt's (partial) annulus in the plane z = height of its own space.
struct Disk {
  Transform world_from_disk;
  float height, radius, inner_radius;
  float phi_max;  ///< [rad]
  bool flip_normals;
};

/// Bilinear patches with shared vertices in world space; corners (0,0) (1,0) (0,1) (1,1).
struct BilinearMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<int, 4>> patches;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  bool flip_normals;
};

using Shape = std::variant<TriangleMesh, Sphere, Disk, BilinearMesh>;

/// What an intersector finds: enough to reconstruct the point.
struct ShapeHit {
  float t;             ///< distance along the ray [scene units]
  uint32_t primitive;  ///< triangle or patch
  Vec2 uv;             ///< barycentric (b1, b2), or the shape's own parameters
};

/// The point of a hit, in the shape's world space. `p` lies on the shape as exactly as float
/// allows, which t alone does not give.
SurfacePoint surface_point(const Shape& shape, uint32_t primitive, Vec2 uv);
Bounds3 bounds(const Shape& shape);
float area(const Shape& shape);
/// A point uniform by area.
ShapeSample sample_area(const Shape& shape, Vec2 u);
/// A point by its direction from `from`: uniform in solid angle where a closed form is known
/// (spheres from outside), else by area. Empty if nothing can be seen from there.
std::optional<ShapeDirectionSample> sample_direction(const Shape& shape, Vec3 from, Vec2 u);
/// Density of sample_direction() for the point `on` of the shape [1/sr].
float direction_pdf(const Shape& shape, Vec3 from, const SurfacePoint& on);

}  // namespace tyndall
