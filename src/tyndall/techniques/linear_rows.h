// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace tyndall {

/// Densities on [0, 1], one per row, each linear between the same equidistant nodes. Immutable.
class LinearRows {
 public:
  LinearRows() = default;
  /// Row-major `values` at the nodes, (rows, cells + 1); positive or zero, and finite.
  LinearRows(std::span<const float> values, int rows);

  class Blend;
  /// Between row i and row i + stride: (1 - weight) of the one and `weight` of the other.
  Blend blend(int row, int stride, float weight) const;

  int rows() const { return rows_; }
  float mass(int row) const { return cdf_[static_cast<size_t>(row + 1) * nodes_ - 1]; }
  /// Number of floats held.
  size_t size() const { return values_.size() + cdf_.size(); }

 private:
  std::vector<float> values_, cdf_;
  size_t nodes_ = 0;
  int rows_ = 0;
};

/// A linear mixture of two rows, again linear between the nodes. The rows must outlive it.
class LinearRows::Blend {
 public:
  /// The density at x in [0, 1]; integrates to mass().
  float density(float x) const;
  /// The integral of the density over [0, x].
  float cdf(float x) const;
  /// The x at which cdf() is `part`, in [0, 1].
  float invert(float part) const;
  float mass() const { return at(cdf_a_, cdf_b_, cells_); }

 private:
  friend class LinearRows;
  float at(const float* a, const float* b, int i) const {
    return (1 - weight_) * a[i] + weight_ * b[i];
  }

  const float *value_a_ = nullptr, *value_b_ = nullptr, *cdf_a_ = nullptr, *cdf_b_ = nullptr;
  float weight_ = 0;
  int cells_ = 0;
};

}  // namespace tyndall
