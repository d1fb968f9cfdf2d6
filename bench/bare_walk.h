// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tyndall/geometry/triangle_mesh.h"
#include "tyndall/media/medium.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// The yardstick of a renderer's speed: the same walk through triangles that hold a medium,
/// with a closest hit, a shadow ray and a transmittance per vertex, by Embree's own calls
/// in its fastest mode and without any light transport around them.
class BareWalk {
 public:
  /// What `medium` fills, up to the triangles. The point `light` is inside.
  BareWalk(const TriangleMesh& mesh, const Medium& medium, Vec3 light);
  ~BareWalk();

  /// A walk of at most `max_depth` vertices. Media scatter evenly, surfaces by the cosine;
  /// from the second vertex on the walk ends as often as `albedo` and `reflectance` say.
  float walk(const Ray& ray, int max_depth, float albedo, float reflectance,
             RandomStream& rng) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tyndall
