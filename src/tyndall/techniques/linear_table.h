// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tyndall/math/elementary.h"

namespace tyndall {

/// A positive function on [x_min, x_max], linear between equidistant nodes and constant
/// beyond the ends, whose integrals from any point are taken and inverted to float
/// precision, however short the way or small the function. Immutable.
class LinearTable {
 public:
  LinearTable() = default;
  /// `values` at the nodes: from two to 2048, positive and finite.
  LinearTable(std::span<const float> values, float x_min, float x_max);

  class Cursor;
  /// Starts integrals at x and takes them upwards if `sign` is 1, downwards if -1.
  Cursor cursor(float x, float sign = 1) const;

  bool is_empty() const { return nodes_.empty(); }
  /// Number of floats held; a double counts as two.
  size_t size() const { return nodes_.size() * sizeof(Node) / sizeof(float); }

 private:
  /// What a look-up wants of a node lies together.
  struct Node {
    double integral;  // from node 0, in cells: a sum of small and large masses
    float value;
    // The position, in cells / fraction, where i and i + 1 shares of the integral end that
    // has as many as there are cells, for the i-th node.
    uint16_t guide[2];
  };
  static constexpr float fraction = 32;

  int cell_at(double integral) const;

  std::vector<Node> nodes_;
  float x_min_ = 0, x_max_ = 0;
  int cells_ = 0;
  float cells_per_x_ = 0, x_per_cell_ = 0;
  float shares_per_integral_ = 0;
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
  Cursor(const LinearTable* table, float position, float sign)
      : table_(table),
        position_(position),
        sign_(sign),
        step_(static_cast<int>(sign)),
        origin_(step_ < 0 ? table->cells_ : 0) {}

  // Nodes are counted from the end where this direction starts.
  const Node& at(int i) const {
    return table_->nodes_[static_cast<size_t>(origin_ + step_ * i)];
  }
  float node(int i) const { return at(i).value; }
  /// The integral up to node i, but for a constant.
  double sum(int i) const { return double{sign_} * at(i).integral; }
  float invert_far(int i, float way, float rest) const;

  const LinearTable* table_ = nullptr;
  float position_ = 0;  // in cells; may be off the table
  float sign_ = 1;
  int step_ = 1, origin_ = 0;
};

inline LinearTable::Cursor LinearTable::cursor(float x, float sign) const {
  const float position = sign * (x - by_sign(sign, x_min_, x_max_)) * cells_per_x_;
  return {this, position == position ? position : 0, sign};
}

inline float LinearTable::Cursor::value(float delta) const {
  const auto cells = static_cast<float>(table_->cells_);
  const float at = position_ + delta * table_->cells_per_x_;
  const float x = at > 0 ? std::min(at, cells) : 0;  // also takes NaN as zero
  const int i = std::min(static_cast<int>(x), table_->cells_ - 1);
  const float a = node(i);
  return a + (x - static_cast<float>(i)) * (node(i + 1) - a);
}

}  // namespace tyndall
