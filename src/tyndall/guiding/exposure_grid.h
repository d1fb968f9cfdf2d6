// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"

namespace tyndall {

/// Predicts how much light from all around, such as that of a sky, gets to where: a box of
/// cells in world space. No line of sight to learn in, so the place must do.
///
/// Relative to the brightest cell, and never below the floor: a wrong prediction costs
/// variance, never bias. Beyond the box it is what it is at the border.
class ExposureGrid {
 public:
  /// About `cells` cells, nearly cubes. Equally exposed everywhere, until measured.
  ExposureGrid(const Bounds3& box, int cells, float floor);

  int slices() const { return size_[2]; }
  /// What arrives at cells of a slice; `exposure` is asked for points in them, in any unit,
  /// and told the number of the cell. Different slices may be measured by different
  /// threads.
  void measure_slice(int slice, const std::function<float(Vec3 p, size_t cell)>& exposure);
  /// To be called once all slices are measured.
  void finish();

  /// In [floor, 1].
  float exposure(Vec3 p) const;
  /// The same for the points ray.at(t[i]); `out` is as long as `t`.
  void exposure(const Ray& ray, std::span<const float> t, std::span<float> out) const;

  size_t memory() const { return values_.size() * sizeof(float); }  ///< [bytes]

 private:
  size_t index(int x, int y, int z) const {
    const auto row =
        static_cast<size_t>(z) * static_cast<size_t>(size_[1]) + static_cast<size_t>(y);
    return row * static_cast<size_t>(size_[0]) + static_cast<size_t>(x);
  }

  Bounds3 box_;
  int size_[3];
  Vec3 scale_;  // cells per scene unit
  float floor_;
  std::vector<float> values_;
};

}  // namespace tyndall
