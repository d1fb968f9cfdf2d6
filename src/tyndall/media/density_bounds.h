// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "tyndall/geometry/cell_walk.h"
#include "tyndall/math/constants.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/brick_grid.h"
#include "tyndall/media/majorant_grid.h"

namespace tyndall {

/// The density that makes an optical depth of 1e6 on the shortest way from one sample to
/// the next; `sigma_t` is the extinction of density one [1/scene unit]. Larger ones look no
/// different, but walks through them do not end. Infinite if `sigma_t` is zero.
float opaque_density(float sigma_t, const Transform& world_from_grid);

template <size_t channels>
class SampleWalk;

/// Majorants and means of one density, or of three whose samples lie in the same places: of
/// coarse cells and, for where those are too rough, from sample to sample.
template <size_t channels>
class DensityBounds {
 public:
  using Densities = std::array<const BrickGrid*, channels>;
  /// Of each density, in the same cell.
  using Cell = std::array<MajorantCell, channels>;

  /// Of densities of which none above `largest` is met; `sigma_t` is the extinction of
  /// density one [1/scene unit]. Precondition: `densities` outlive this and have the same
  /// number of bricks.
  DensityBounds(const Densities& densities, float sigma_t, float largest);

  /// Through the coarse cells from 0 to `t_max`.
  CellWalk walk(const GridRay& ray, float t_max) const {
    return grids_[0].walk(ray, t_max);
  }
  Cell cell(size_t index) const {
    Cell found;
    for (size_t c = 0; c < channels; ++c) found[c] = grids_[c].cell(index);
    return found;
  }
  /// Whether a ray over this length of a coarse cell would meet a majorant so often, and
  /// mostly in vain, that bounds from sample to sample are worth finding.
  bool is_rough(const Cell& cell, float length) const {
    constexpr float in_vain = 8;
    return std::any_of(cell.begin(), cell.end(), [&](const MajorantCell& c) {
      return c.majorant * length > rough_ && c.majorant > in_vain * c.mean;
    });
  }
  static bool is_empty(const Cell& cell) {
    return std::all_of(cell.begin(), cell.end(),
                       [](const MajorantCell& c) { return c.majorant == 0; });
  }
  /// Through the cells between samples on a stretch of a ray.
  std::unique_ptr<SampleWalk<channels>> look_closer(const GridRay& ray, float t_min,
                                                    float t_max) const;
  Cell cell_between_samples(size_t index) const;

  size_t memory() const;  ///< [bytes]

 private:
  Densities densities_;
  std::array<MajorantGrid, channels> grids_;
  float largest_;
  float rough_ = infinity;  // densities times lengths from which cells may be rough
};

/// From sample to sample on a stretch of a ray.
template <size_t channels>
class SampleWalk {
 public:
  using Bounds = DensityBounds<channels>;

  SampleWalk(const Bounds& bounds, const CellWalk& walk) : bounds_(bounds), walk_(walk) {}

  struct Found {
    float t_min, t_max;
    typename Bounds::Cell cell;
  };
  /// The next cell that is not empty. Empty at the end.
  std::optional<Found> next();

 private:
  const Bounds& bounds_;
  CellWalk walk_;
};

extern template class SampleWalk<1>;
extern template class SampleWalk<3>;
extern template class DensityBounds<1>;
extern template class DensityBounds<3>;

}  // namespace tyndall
