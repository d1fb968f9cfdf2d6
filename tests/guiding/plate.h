// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/constants.h"

namespace tyndall {

/// An opaque plane z = height with round holes: the occluder of literature study H.
struct Plate {
  struct Hole {
    Vec2 center;
    float radius;
  };

  float height = 0.5f;
  std::vector<Hole> holes;

  /// Distance along the ray to the plate; infinity if it is missed.
  float distance(const Ray& ray) const {
    const float t = (height - ray.o.z) / ray.d.z;
    if (!(t > 0 && t < infinity)) return infinity;
    const Vec3 p = ray.at(t);
    for (const Hole& hole : holes)
      if (sqr(p.x - hole.center.x) + sqr(p.y - hole.center.y) < sqr(hole.radius))
        return infinity;
    return t;
  }

  bool is_visible(Vec3 from, Vec3 to) const {
    const float length_of_segment = length(to - from);
    return !(distance({from, (to - from) / length_of_segment}) < length_of_segment);
  }
};

/// Five holes of different sizes, not symmetrical.
inline Plate perforated_plate() {
  return {0.5f,
          {{{0.1f, 0.05f}, 0.15f},
           {{-0.4f, 0.2f}, 0.2f},
           {{0.5f, -0.3f}, 0.1f},
           {{-0.1f, -0.6f}, 0.25f},
           {{0.9f, 0.7f}, 0.3f}}};
}

}  // namespace tyndall
