// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace tyndall {

/// Densities on [0, 1], one per row, each linear between the same equidistant nodes.
/// Immutable.
class LinearRows {
 public:
  LinearRows() = default;
  /// Row-major `values` at the nodes, (rows, cells + 1); positive or zero, and finite.
  /// There are 64 cells.
  LinearRows(std::span<const float> values, int rows);

  class Blend;
  /// Between row i and row i + stride: (1 - weight) of the one and `weight` of the other.
  Blend blend(int row, int stride, float weight) const;
  /// Row i alone.
  Blend row(int i) const;

  int rows() const { return rows_; }
  float mass(int row) const { return cdf_[static_cast<size_t>(row + 1) * nodes_ - 1]; }
  /// Number of floats held.
  size_t size() const { return values_.size() + cdf_.size() + blocks_.size(); }

 private:
  static constexpr int block = 8;  // a search looks at so many numbers at once, twice

  std::vector<float> values_, cdf_;
  std::vector<float> blocks_;  // of cdf_ every eighth
  size_t nodes_ = 0;
  int rows_ = 0;
};

/// A linear mixture of two rows, again linear between the nodes. The rows must outlive it.
class LinearRows::Blend {
 public:
  struct Point {
    float x;        ///< in [0, 1]
    float density;  ///< there
  };

  /// The density at x in [0, 1]; integrates to mass().
  float density(float x) const {
    const float at_x = position(x);
    const int i = cell(at_x);
    const float f = at_x - static_cast<float>(i), a = mix(value_a_, value_b_, i);
    return a + f * (mix(value_a_, value_b_, i + 1) - a);
  }
  /// The integral of the density over [0, x].
  float cdf(float x) const {
    const float at_x = position(x);
    const int i = cell(at_x);
    const float f = at_x - static_cast<float>(i), a = mix(value_a_, value_b_, i);
    const float slope = mix(value_a_, value_b_, i + 1) - a;
    return mix(cdf_a_, cdf_b_, i) + f * (a + 0.5f * f * slope) / static_cast<float>(cells_);
  }
  /// The point at which cdf() is `part`.
  Point invert(float part) const {
    const int eighth = last_below(block_a_, block_b_, part);
    const int first = eighth * block;
    const int i = first + last_below(cdf_a_ + first, cdf_b_ + first, part);
    const float a = mix(value_a_, value_b_, i);
    const float slope = mix(value_a_, value_b_, i + 1) - a;
    const auto cells = static_cast<float>(cells_);
    const float mass = std::max((part - mix(cdf_a_, cdf_b_, i)) * cells, 0.0f);
    const float root = std::sqrt(std::max(a * a + 2 * slope * mass, 0.0f));
    const float f = a + root > 0 ? std::min(2 * mass / (a + root), 1.0f) : 0;
    return {(static_cast<float>(i) + f) / cells, a + f * slope};
  }
  float mass() const { return mix(cdf_a_, cdf_b_, cells_); }

 private:
  friend class LinearRows;
  float mix(const float* a, const float* b, int i) const {
    return a[i] + weight_ * (b[i] - a[i]);
  }
  float position(float x) const {
    return (x > 0 ? std::min(x, 1.0f) : 0) * static_cast<float>(cells_);
  }
  int cell(float position) const {
    return std::min(static_cast<int>(position), cells_ - 1);
  }
  /// The last of eight growing numbers that is at most `part`, or the first.
  int last_below(const float* a, const float* b, float part) const {
    int below = 0;
    for (int i = 1; i < block; ++i) below += mix(a, b, i) <= part ? 1 : 0;
    return below;
  }

  const float *value_a_ = nullptr, *value_b_ = nullptr, *cdf_a_ = nullptr,
              *cdf_b_ = nullptr;
  const float *block_a_ = nullptr, *block_b_ = nullptr;
  float weight_ = 0;
  int cells_ = 0;
};

inline LinearRows::Blend LinearRows::blend(int row, int stride, float weight) const {
  assert(0 <= row && row < rows_ && 0 <= row + stride && row + stride < rows_);
  const auto a = static_cast<size_t>(row), b = static_cast<size_t>(row + stride);
  Blend blend;
  blend.value_a_ = values_.data() + a * nodes_;
  blend.value_b_ = values_.data() + b * nodes_;
  blend.cdf_a_ = cdf_.data() + a * nodes_;
  blend.cdf_b_ = cdf_.data() + b * nodes_;
  blend.block_a_ = blocks_.data() + a * block;
  blend.block_b_ = blocks_.data() + b * block;
  blend.weight_ = weight;
  blend.cells_ = static_cast<int>(nodes_) - 1;
  return blend;
}

inline LinearRows::Blend LinearRows::row(int i) const { return blend(i, 0, 0); }

}  // namespace tyndall
