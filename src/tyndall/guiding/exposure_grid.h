// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/guiding/cell_grid.h"

namespace tyndall {

/// Predicts how much light from all around, such as that of a sky, gets to where: a box of
/// cells in world space. No line of sight to learn in, so the place must do.
///
/// Relative to the brightest cell, and never below the floor: a wrong prediction costs
/// variance, never bias. Beyond the box it is what it is at the border.
class ExposureGrid {
 public:
  /// Equally exposed everywhere, until measured.
  ExposureGrid(const CellGrid& grid, float floor);

  /// What arrives at a cell, in any unit. From any thread, for different cells.
  void set(size_t cell, float exposure);
  /// To be called once all cells are set.
  void finish();

  /// In [floor, 1].
  float exposure(Vec3 p) const;
  /// The same for the points ray.at(t[i]); `out` is as long as `t`.
  void exposure(const Ray& ray, std::span<const float> t, std::span<float> out) const;

  size_t memory() const { return values_.size() * sizeof(float); }  ///< [bytes]

 private:
  CellGrid grid_;
  float floor_;
  std::vector<float> values_;
};

}  // namespace tyndall
