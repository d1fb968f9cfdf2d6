// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>

#include "tyndall/geometry/cell_walk.h"
#include "tyndall/geometry/grid_space.h"
#include "tyndall/media/density_bounds.h"

namespace tyndall {

/// A ray's way through grids of densities: the stretches on which there is a majorant, in
/// order. DDA over coarse cells and, in those that are rough, from sample to sample.
template <size_t channels>
class GridWalk {
 public:
  using Bounds = DensityBounds<channels>;

  /// Over the part of a ray that `clip` is; over nothing if that is empty. Precondition:
  /// `bounds` outlives this.
  GridWalk(const Bounds& bounds, const std::optional<GridSpace::Clip>& clip)
      : bounds_(&bounds) {
    if (!clip) return;
    ray_ = clip->ray;
    t_offset_ = clip->t_offset;
    walk_ = bounds.walk(ray_, clip->length);
  }

  struct Stretch {
    float t_min, t_max;  ///< distances along the world's ray
    typename Bounds::Cell cell;
  };

  /// Writes the next stretch; false at the end.
  [[gnu::always_inline]] bool next(Stretch& stretch) {
    for (;;) {
      if (closer_) [[unlikely]]
        if (next_closer(stretch)) return true;
      CellWalk::Step step;
      if (!walk_.next(step)) return false;
      const typename Bounds::Cell cell = bounds_->cell(step.cell);
      if (Bounds::is_empty(cell)) continue;
      if (bounds_->is_rough(cell, step.t_max - step.t_min)) [[unlikely]] {
        closer_ = bounds_->look_closer(ray_, step.t_min, step.t_max);
        continue;
      }
      stretch = {t_offset_ + step.t_min, t_offset_ + step.t_max, cell};
      return true;
    }
  }

  /// The point at a distance along the world's ray, in grid space.
  Vec3 p_grid(float t) const { return ray_.at(t - t_offset_); }

 private:
  bool next_closer(Stretch& stretch) {
    const auto found = closer_->next();
    if (found)
      stretch = {t_offset_ + found->t_min, t_offset_ + found->t_max, found->cell};
    else
      closer_.reset();
    return found.has_value();
  }

  const Bounds* bounds_;
  GridRay ray_;
  float t_offset_ = 0;
  CellWalk walk_;
  // On the way through a rough cell. Elsewhere in memory, as it is rare: what functions
  // that are not inline know of the rest cannot be kept in registers.
  std::unique_ptr<SampleWalk<channels>> closer_;
};

}  // namespace tyndall
