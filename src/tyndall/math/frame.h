// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "tyndall/math/vec.h"

namespace tyndall {

/// A right-handed orthonormal basis.
struct Frame {
  Vec3 x, y, z;

  /// The frame whose z axis is the unit vector `z`; its x axis is arbitrary but continuous
  /// except at z.z = 0 [Duff17].
  static Frame from_z(Vec3 z) {
    const float sign = std::copysign(1.0f, z.z);
    const float a = -1 / (sign + z.z);
    const float b = z.x * z.y * a;
    return {{1 + sign * sqr(z.x) * a, sign * b, -sign * z.x},
            {b, sign + sqr(z.y) * a, -z.y},
            z};
  }

  Vec3 to_world(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 to_local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

}  // namespace tyndall
