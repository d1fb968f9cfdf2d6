// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "tyndall/geometry/ray_intersection.h"
#include "tyndall/geometry/shape.h"

namespace tyndall {

/// A shape with all that rays need of it, computed once.
class TargetShape {
 public:
  /// A ray meets the shape with the probability `alpha`, as if the shape had holes: a hash
  /// of the ray and of `salt`, another number for each shape, decides.
  explicit TargetShape(const Shape& shape, float alpha = 1, uint64_t salt = 0);

  const Shape& shape() const { return *shape_; }
  /// The shape as a triangle mesh, null if it is another one.
  const TriangleMesh* mesh() const { return mesh_; }
  /// Of the mesh [scene units].
  float longest_edge() const { return longest_edge_; }
  /// Triangles, patches, or one for a quadric.
  size_t primitive_count() const;
  /// Of a shape that is no mesh of triangles; empty if it is not finite.
  Bounds3 primitive_bounds(uint32_t primitive) const;

  /// Whether rays meet the shape by chance only.
  bool is_translucent() const { return alpha_ < 1; }
  /// Whether the ray meets, rather than goes through, the n-th hit that it has with a
  /// primitive. The same whenever it is asked for the same ray.
  bool is_met_by(const PreciseRay& ray, uint32_t primitive, int n = 0) const;

  /// The closest hit at a distance in (0, t_max). Precondition: mesh() is null.
  std::optional<PreciseHit> intersect(uint32_t primitive, const PreciseRay& ray,
                                      double t_max) const;
  /// The distance of intersect() alone, for less.
  std::optional<double> distance(uint32_t primitive, const PreciseRay& ray,
                                 double t_max) const;

  /// Whether a triangle of the mesh is in front of the ray and not behind its end, exactly.
  bool is_between_ends(uint32_t triangle, const PreciseRay& ray, float t_max) const {
    const PreciseTriangle t = mesh_->triangle(triangle);
    return starts_in_front(t, ray) && plane_distance(t, ray) < static_cast<double>(t_max);
  }
  /// Whether rounding to float may have made a hit at the distance `t` of a ray that ends
  /// at `t_max` out of a triangle that the ray starts from or ends on. `slope` is the
  /// length along the triangle's normal, twice its area, of the ray's direction.
  bool may_be_at_end(float t, float t_max, float slope) const {
    // Distances to the triangle's plane times twice its area, and how wrong single
    // precision may be about them: a few roundings of products of lengths up to these.
    const float nearest_end = std::min(t, t_max - t) * slope;
    const float error = 32 * 0x1p-23f * sqr(longest_edge_) * (longest_edge_ + t);
    return !(nearest_end > error);
  }

 private:
  std::optional<PreciseHit> closest(uint32_t primitive, const PreciseRay& ray,
                                    double t_max) const;

  const Shape* shape_;
  const TriangleMesh* mesh_;
  std::variant<std::monostate, SphereIntersector, DiskIntersector> quadric_;
  float longest_edge_ = 0;
  float alpha_;
  uint64_t salt_;
};

}  // namespace tyndall
