// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tyndall/math/vec.h"

namespace tyndall {

/// An index drawn from a table.
struct DiscreteSample {
  size_t index;
  float probability;
  float u_remapped;  ///< uniform in [0, 1), for reuse
};

/// Chooses an index in proportion to its weight, in logarithmic time.
class DiscreteDistribution {
 public:
  DiscreteDistribution() = default;
  /// Weights are non-negative and finite; if all are zero, every index is alike.
  explicit DiscreteDistribution(std::span<const float> weights);

  /// Precondition: not empty.
  DiscreteSample sample(float u) const;
  float probability(size_t index) const;
  size_t size() const { return cdf_.size(); }

 private:
  std::vector<float> cdf_;  // inclusive, last is exactly 1
};

/// A position drawn from a piecewise constant density on [0, 1].
struct PiecewiseSample {
  float x;
  float pdf;
};

/// Piecewise constant density on [0, 1], bins of equal width.
class PiecewiseConstant1D {
 public:
  PiecewiseConstant1D() = default;
  /// Values are non-negative and finite, and not empty; if all are zero, the density is
  /// one.
  explicit PiecewiseConstant1D(std::span<const float> values);

  PiecewiseSample sample(float u) const;
  float pdf(float x) const;                     ///< zero outside [0, 1]
  float invert(float x) const;                  ///< the u that sample() maps to x in [0, 1]
  float integral() const { return integral_; }  ///< of the values over [0, 1]
  /// Of the object and its tables [bytes].
  size_t memory() const {
    return sizeof(*this) + (densities_.size() + cdf_.size()) * sizeof(float);
  }

 private:
  std::vector<float> densities_;
  std::vector<float> cdf_;  // inclusive, last is exactly 1
  float integral_ = 0;
};

/// A position drawn from a piecewise constant density on the unit square.
struct PiecewiseSample2D {
  Vec2 p;
  float pdf;
};

/// Piecewise constant density on the unit square, row-major, row 0 at y = 0.
class PiecewiseConstant2D {
 public:
  PiecewiseConstant2D() = default;
  /// Values are non-negative and finite, `width` times `height` of them, both positive.
  PiecewiseConstant2D(std::span<const float> values, int width, int height);

  PiecewiseSample2D sample(Vec2 u) const;
  float pdf(Vec2 p) const;    ///< zero outside the square
  Vec2 invert(Vec2 p) const;  ///< the u that sample() maps to p in the square
  size_t memory() const;      ///< of the object and its tables [bytes]

 private:
  std::vector<PiecewiseConstant1D> rows_;
  PiecewiseConstant1D marginal_;
};

}  // namespace tyndall
