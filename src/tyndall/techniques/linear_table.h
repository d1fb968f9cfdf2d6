// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tyndall {

/// A positive function on [x_min, x_max], linear between equidistant nodes and constant
/// beyond the ends, whose integrals from any point are taken and inverted to float
/// precision, however short the way or small the function. Immutable.
class LinearTable {
 public:
  LinearTable() = default;
  /// `values` at the nodes: at least two, positive and finite.
  LinearTable(std::span<const float> values, float x_min, float x_max);

  class Cursor;
  /// Starts integrals at x and takes them upwards, or downwards if `is_reversed`.
  Cursor cursor(float x, bool is_reversed = false) const;

  bool is_empty() const { return values_.empty(); }
  /// Number of floats held; a double counts as two.
  size_t size() const { return values_.size() + 2 * integral_.size() + guide_.size() / 2; }

 private:
  std::vector<float> values_;
  std::vector<double> integral_;  // to each node, in cells: sums of small and large masses
  std::vector<uint16_t> guide_;   // the cell where each of `cells` equal masses starts
  float x_min_ = 0, x_max_ = 0;
  int cells_ = 0;
  float cells_per_x_ = 0;
  double guides_per_mass_ = 0;

  int cell_at(double integral) const;
};

/// A point of a table and a direction. Distances `delta` from it are not negative. The
/// table must outlive it.
class LinearTable::Cursor {
 public:
  Cursor() = default;

  /// The function at distance delta.
  float value(float delta) const;
  /// The integral of the function over the way of length delta.
  float integral(float delta) const;
  /// The distance up to which the integral is `mass`; not negative.
  float invert(float mass) const;

 private:
  friend class LinearTable;
  Cursor(const LinearTable* table, float position, bool is_reversed)
      : table_(table),
        position_(position),
        origin_(is_reversed ? table->cells_ : 0),
        step_(is_reversed ? -1 : 1) {}

  // Nodes are counted from the end where this direction starts.
  float node(int i) const {
    return table_->values_[static_cast<size_t>(origin_ + step_ * i)];
  }
  /// The integral up to node i, but for a constant.
  double sum(int i) const {
    return step_ * table_->integral_[static_cast<size_t>(origin_ + step_ * i)];
  }
  const LinearTable* table_ = nullptr;
  float position_ = 0;  // in cells; may be off the table
  int origin_ = 0, step_ = 1;
};

}  // namespace tyndall
