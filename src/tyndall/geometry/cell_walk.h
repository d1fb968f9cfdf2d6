// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "tyndall/math/constants.h"
#include "tyndall/math/scalar.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// A line through grid space: o + t d. `t` is a distance in world space, `d` not unit.
struct GridRay {
  Vec3 o, d;

  Vec3 at(float t) const { return o + d * t; }
};

/// Walks along a ray through the cubic cells of a grid, in order [AW87].
class CellWalk {
 public:
  /// A walk over nothing.
  CellWalk() = default;
  /// Through `n` cells of the given edge, from `t_min` to `t_max`. Precondition: both
  /// points lie in the grid, up to rounding.
  CellWalk(Vec3i n, float edge, const GridRay& ray, float t_min, float t_max)
      : t_(t_min), t_max_(t_max) {
    const Vec3 p = ray.at(t_min);
    const size_t strides[3] = {1, static_cast<size_t>(n.x),
                               static_cast<size_t>(n.x) * static_cast<size_t>(n.y)};
    const int counts[3] = {n.x, n.y, n.z};
    for (int axis = 0; axis < 3; ++axis) {
      const int cell = std::clamp(static_cast<int>(p[axis] / edge), 0, counts[axis] - 1);
      index_ += static_cast<size_t>(cell) * strides[axis];
      Axis& a = axes_[axis];
      if (ray.d[axis] == 0) continue;
      const bool is_up = ray.d[axis] > 0;
      const float inv = 1 / ray.d[axis];
      const float plane = static_cast<float>(is_up ? cell + 1 : cell) * edge;
      a.t_next = std::max((plane - ray.o[axis]) * inv, t_min);
      a.t_step = magnitude(edge * inv);
      a.steps_left = is_up ? counts[axis] - 1 - cell : cell;
      a.stride = is_up ? strides[axis] : size_t{0} - strides[axis];
    }
  }

  /// A stretch of the ray within one cell.
  struct Step {
    float t_min, t_max;
    size_t cell;  ///< index, x fastest, then y, then z
  };

  /// Writes the next stretch; they touch each other. False at the end.
  bool next(Step& step) {
    if (!(t_ < t_max_)) return false;
    const int axis = axes_[0].t_next < axes_[1].t_next
                         ? (axes_[0].t_next < axes_[2].t_next ? 0 : 2)
                         : (axes_[1].t_next < axes_[2].t_next ? 1 : 2);
    Axis& a = axes_[axis];
    step = {t_, std::min(a.t_next, t_max_), index_};
    if (a.steps_left-- == 0) {
      step.t_max = t_max_;  // what is left are rounding errors
    } else {
      index_ += a.stride;
      a.t_next += a.t_step;
    }
    t_ = step.t_max;
    return true;
  }

 private:
  struct Axis {
    float t_next = infinity;  // where the ray leaves the cell along this axis
    float t_step = infinity;
    int steps_left = 0;
    size_t stride = 0;
  };

  Axis axes_[3];
  float t_ = 0, t_max_ = 0;
  size_t index_ = 0;
};

}  // namespace tyndall
