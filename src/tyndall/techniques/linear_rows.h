// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tyndall {

/// Densities of mass one, one per row, each linear within equal cells; cells may be in
/// several pieces, between which it jumps. Immutable.
class LinearRows {
 public:
  LinearRows() = default;
  /// Row-major `values` at the nodes, (rows, pieces, nodes of a piece), positive or zero,
  /// finite, and not all zero in a row: a row is scaled to mass one.
  LinearRows(std::span<const float> values, int rows, int pieces);

  class Blend;
  /// Between row i and row i + 1: (1 - weight) of the one and `weight` of the other.
  Blend blend(int row, float weight) const;
  /// Row i alone.
  Blend row(int i) const;

  int rows() const { return rows_; }
  /// Number of floats held.
  size_t size() const { return cells_.size() * sizeof(Cell) / sizeof(float); }

 private:
  /// All that a look-up wants of a cell of a row lies together, with the row's neighbour's
  /// next to it: seldom used tables are not in the processor's caches.
  struct Cell {
    float cdf;          // at its left end
    float left, right;  // the density at its ends, in masses per cell
    // Where the cdf is i / cells and (i + 1) / cells, for the i-th cell: in cells /
    // fraction.
    uint16_t guide[2];
  };
  static constexpr float fraction = 256;

  const Cell& cell(int i, int row) const {
    return cells_[static_cast<size_t>(i) * static_cast<size_t>(rows_) +
                  static_cast<size_t>(row)];
  }
  void add_row(std::span<const float> values, int row, int pieces);

  std::vector<Cell> cells_;  // (cell, row)
  int rows_ = 0, row_cells_ = 0;
};

/// A linear mixture of two rows, again linear within cells. The rows must outlive it.
class LinearRows::Blend {
 public:
  /// A point of a row: a cell, and how much of it lies to the left, in [0, 1].
  struct Place {
    int cell;
    float part;
  };
  struct Point {
    Place place;
    float density;  ///< there, in masses per cell
  };

  /// Of the given piece, at x in [0, 1] along its `cells`.
  static Place place(float x, int piece, int cells) {
    const float at = (x > 0 ? std::min(x, 1.0f) : 0) * static_cast<float>(cells);
    const int i = std::min(static_cast<int>(at), cells - 1);
    return {piece * cells + i, at - static_cast<float>(i)};
  }

  float density(const Place& at) const {
    const Mixed c = mixed(at.cell);
    return c.left + at.part * (c.right - c.left);
  }
  /// The integral of the density up to there.
  float cdf(const Place& at) const {
    const Mixed c = mixed(at.cell);
    return c.cdf + at.part * (c.left + 0.5f * at.part * (c.right - c.left));
  }
  /// The point at which cdf() is u in [0, 1].
  Point invert(float u) const {
    int i = guess(u);
    Mixed c = mixed(i);
    while (u >= c.cdf + c.mass() && i + 1 < rows_->row_cells_) c = mixed(++i);
    while (u < c.cdf && i > 0) c = mixed(--i);
    const float mass = std::max(u - c.cdf, 0.0f), slope = c.right - c.left;
    const float root = std::sqrt(std::max(c.left * c.left + 2 * slope * mass, 0.0f));
    const float sum = c.left + root;
    const float part = sum > 0 ? std::min(2 * mass / sum, 1.0f) : 0;
    return {{i, part}, c.left + part * slope};
  }

 private:
  friend class LinearRows;
  struct Mixed {
    float cdf, left, right;
    float mass() const { return 0.5f * (left + right); }
  };
  Blend(const LinearRows* rows, int row, int next, float weight)
      : rows_(rows), row_(row), next_(next), weight_(weight) {}

  Mixed mixed(int i) const {
    const Cell &a = rows_->cell(i, row_), &b = rows_->cell(i, next_);
    return {mix(a.cdf, b.cdf), mix(a.left, b.left), mix(a.right, b.right)};
  }
  float mix(float a, float b) const { return a + weight_ * (b - a); }
  /// About the cell in which the cdf is u: that of a mixture lies between its rows'.
  int guess(float u) const {
    const int last = rows_->row_cells_ - 1;
    const float at = u * static_cast<float>(rows_->row_cells_);
    const int i = std::clamp(static_cast<int>(at), 0, last);
    const Cell &a = rows_->cell(i, row_), &b = rows_->cell(i, next_);
    const float x = mix(a.guide[0], b.guide[0]), y = mix(a.guide[1], b.guide[1]);
    const float there = x + (at - static_cast<float>(i)) * (y - x);
    return std::clamp(static_cast<int>(there * (1 / fraction)), 0, last);
  }

  const LinearRows* rows_;
  int row_, next_;
  float weight_;
};

inline LinearRows::Blend LinearRows::blend(int row, float weight) const {
  assert(0 <= row && row + 1 < rows_);
  return {this, row, row + 1, weight};
}

inline LinearRows::Blend LinearRows::row(int i) const { return {this, i, i, 0}; }

}  // namespace tyndall
