// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/geometry/scene_hit.h"
#include "tyndall/geometry/shape.h"
#include "tyndall/math/transform.h"

namespace tyndall {

class EmbreeScenes;

/// Which shapes a ray sees.
enum class RayMask : uint32_t {
  opaque = 1,    ///< all but interfaces
  boundary = 2,  ///< interfaces between media only
  all = 3,
};

/// Where a ray goes through boundaries, in order.
using Crossings = boost::container::small_vector<Crossing, 4>;

/// Finds the first of many shapes that a ray meets. Embree behind it; immutable and safe to
/// use from all threads once built.
class Intersector {
 public:
  /// A shape and whether it is only the boundary between media.
  struct Member {
    const Shape* shape;  ///< must outlive the intersector
    bool is_boundary;
    /// The share of rays that meet it; which do is the same in all queries of a ray.
    /// Boundaries are met by all.
    float alpha = 1;
  };
  using Group = std::vector<Member>;
  struct Instance {
    uint32_t group;
    Transform world_from_group;
  };

  /// Group 0 is the world itself; the others appear only through `instances`, whose
  /// transforms are affine. Throws std::runtime_error if memory runs out.
  Intersector(std::span<const Group> groups, std::span<const Instance> instances);
  ~Intersector();
  Intersector(const Intersector&) = delete;
  Intersector& operator=(const Intersector&) = delete;

  /// The closest hit at a distance in (0, t_max). Use offset_origin() for rays that leave a
  /// surface: triangles that the origin is not exactly in front of are never hit, so that
  /// no distance needs to be skipped. Rays from farther than 1e18, or not finite, hit
  /// nothing.
  std::optional<SceneHit> intersect(const Ray& ray, float t_max, RayMask mask) const;
  /// The same in two steps: the point of a hit costs as much as a ray through a small
  /// scene, and many hits are not asked for it. `ray` is the one that found the hit.
  std::optional<RayHit> find(const Ray& ray, float t_max, RayMask mask) const;
  SceneHit resolve(const Ray& ray, const RayHit& hit) const;
  /// As find(), but boundaries do not stop the ray: it goes through all in front of the
  /// hit, which it writes to `crossings`. Of coincident boundaries it crosses each.
  std::optional<RayHit> find_through(const Ray& ray, float t_max, RayMask mask,
                                     Crossings& crossings) const;
  /// Whether intersect() would find anything.
  bool is_occluded(const Ray& ray, float t_max, RayMask mask) const;

  Bounds3 bounds() const;

 private:
  std::unique_ptr<const EmbreeScenes> scenes_;
};

/// The point `p` of a surface moved off it to the side that `d` leaves to, by a few units
/// in the last place of each coordinate, so that a ray from there does not hit the same
/// surface again. [WB19] moves points a hundred times farther: here intersections decide in
/// double precision.
Vec3 offset_origin(Vec3 p, Vec3 ng, Vec3 d);

/// How far before the point `end` of a surface with normal `ng` a ray from `p`, or from
/// offset_origin(p), towards it may already meet the surface, because coordinates are
/// rounded [scene units]: much in places that are far from the origin. At most the
/// distance.
float rounded_end(Vec3 p, Vec3 end, Vec3 ng);

}  // namespace tyndall
