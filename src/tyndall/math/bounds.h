// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "tyndall/math/vec.h"

namespace tyndall {

/// A closed interval of distances along a ray.
struct Interval {
  float min, max;
};

/// An axis-aligned box; empty until extended.
struct Bounds3 {
  Vec3 min{infinity, infinity, infinity};
  Vec3 max{-infinity, -infinity, -infinity};

  constexpr bool is_empty() const {
    return min.x > max.x || min.y > max.y || min.z > max.z;
  }
  constexpr Vec3 center() const { return (min + max) * 0.5f; }
  constexpr Vec3 diagonal() const { return max - min; }
  /// Of the sphere around center() that holds the box.
  float radius() const { return is_empty() ? 0 : 0.5f * length(diagonal()); }
  constexpr bool contains(Vec3 p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z &&
           p.z <= max.z;
  }
  constexpr void extend(Vec3 p) {
    min = tyndall::min(min, p);
    max = tyndall::max(max, p);
  }
  constexpr void extend(const Bounds3& b) {
    min = tyndall::min(min, b.min);
    max = tyndall::max(max, b.max);
  }
  Vec3 corner(int i) const {
    return {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z};
  }

  /// The part of [0, t_max] of the line o + t d that lies in the box. `d` need not be unit.
  std::optional<Interval> intersect(Vec3 o, Vec3 d, float t_max) const {
    Interval t{0, t_max};
    for (int axis = 0; axis < 3; ++axis) {
      if (d[axis] == 0) {
        if (o[axis] < min[axis] || o[axis] > max[axis]) return std::nullopt;
        continue;
      }
      const float inv = 1 / d[axis];
      const float a = (min[axis] - o[axis]) * inv;
      const float b = (max[axis] - o[axis]) * inv;
      t.min = std::max(t.min, std::min(a, b));
      t.max = std::min(t.max, std::max(a, b));
    }
    if (!(t.min < t.max)) return std::nullopt;
    return t;
  }
};

}  // namespace tyndall
