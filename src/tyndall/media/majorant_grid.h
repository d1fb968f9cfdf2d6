// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tyndall/geometry/cell_walk.h"
#include "tyndall/math/constants.h"
#include "tyndall/math/vec.h"
#include "tyndall/media/brick_grid.h"

namespace tyndall {

/// Bounds of a density in one coarse cell.
struct MajorantCell {
  float majorant = 0;  ///< >= the interpolant everywhere in the cell
  float mean = 0;      ///< of the interpolant; positive if `majorant` is

  /// Between two samples of a density of which nothing above `largest` is met.
  static MajorantCell of(const BrickGrid& density, Vec3i first, Vec3i last, float largest) {
    constexpr float rounding = 1e-6f;  // a few errors of the interpolation
    const BrickGrid::Range range = density.range(first, last, largest);
    const float majorant = std::min(range.max * (1 + rounding), largest);
    return {majorant, std::min(range.mean, majorant)};
  }
};

/// Majorants and means of a BrickGrid on coarse cells, aligned with its samples, so that
/// they are tight: the majorant is the largest sample of the cell.
class MajorantGrid {
 public:
  /// At most this many cells along an axis: what bounds the cost of a ray.
  static constexpr int max_resolution = 32;

  MajorantGrid() = default;
  /// Of a density of which nothing above `largest` is met. Built in parallel.
  explicit MajorantGrid(const BrickGrid& density, float largest = infinity);

  Vec3i resolution() const { return resolution_; }
  float cell_edge() const { return edge_; }  ///< [samples]
  const MajorantCell& cell(size_t index) const { return cells_[index]; }
  const MajorantCell& cell(Vec3i c) const { return cells_[index(c)]; }
  size_t index(Vec3i c) const {
    return (static_cast<size_t>(c.z) * static_cast<size_t>(resolution_.y) +
            static_cast<size_t>(c.y)) *
               static_cast<size_t>(resolution_.x) +
           static_cast<size_t>(c.x);
  }
  /// Through the cells from 0 to `t_max`. Precondition: both points lie in the grid, up to
  /// rounding.
  CellWalk walk(const GridRay& ray, float t_max) const {
    return {resolution_, edge_, ray, 0, t_max};
  }
  size_t memory() const { return cells_.size() * sizeof(MajorantCell); }  ///< [bytes]

 private:
  Vec3i resolution_;
  float edge_ = 1;
  std::vector<MajorantCell> cells_;
};

}  // namespace tyndall
