// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace tyndall {

/// A positive function on [x_min, x_max], linear between equidistant nodes and constant beyond
/// the ends, whose integrals from any point are taken and inverted to float precision, however
/// short the way or small the function. Immutable.
class LinearTable {
 public:
  LinearTable() = default;
  /// `values` at the nodes: at least two, positive and finite.
  LinearTable(std::span<const float> values, float x_min, float x_max);

  class Cursor;
  /// Starts integrals at x and takes them upwards, or downwards if `is_reversed`.
  Cursor cursor(float x, bool is_reversed = false) const;

  bool is_empty() const { return values_.empty(); }
  int cells() const { return cells_; }

 private:
  std::vector<float> values_;
  std::vector<double> integral_;  // to each node, in cells: sums of small and large masses
  float x_min_ = 0, x_max_ = 0;
  int cells_ = 0;
  float cells_per_x_ = 0;
};

/// A point of a table and a direction. Distances `delta` from it are not negative. The table
/// must outlive it.
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
      : table_(table), position_(position), is_reversed_(is_reversed) {}

  float node(int i) const { return table_->values_[index(i)]; }
  double sum(int i) const {  // from node 0 of this direction to node i, up to a constant
    const double s = table_->integral_[index(i)];
    return is_reversed_ ? -s : s;
  }
  size_t index(int i) const {
    return static_cast<size_t>(is_reversed_ ? table_->cells_ - i : i);
  }
  int last_node_below(double target, int from) const;

  const LinearTable* table_ = nullptr;
  float position_ = 0;  // in cells from the first node of this direction; may be off the table
  bool is_reversed_ = false;
};

}  // namespace tyndall
