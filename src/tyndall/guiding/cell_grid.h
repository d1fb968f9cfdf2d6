// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "tyndall/math/bounds.h"

namespace tyndall {

/// A box divided into cells, nearly cubes.
class CellGrid {
 public:
  /// About `cells` of them; no axis has more than 128. Flat boxes, and points, are given
  /// some thickness. Preconditions: the box is not empty, `cells` is positive.
  CellGrid(const Bounds3& box, int cells);

  size_t count() const;
  int size(int axis) const { return size_[static_cast<size_t>(axis)]; }
  /// Number of a cell by its place along each axis; x varies fastest.
  size_t index(int x, int y, int z) const;
  /// The cell that holds p; of points beyond the box, the nearest.
  size_t find(Vec3 p) const;
  Vec3 middle(int x, int y, int z) const;
  /// In cells from the corner of the box.
  Vec3 position(Vec3 p) const { return (p - min_) * scale_; }

 private:
  Vec3 min_;
  std::array<int, 3> size_;
  Vec3 scale_;  // cells per scene unit
  Vec3 edges_;  // of a cell; none where the box is flat
};

}  // namespace tyndall
