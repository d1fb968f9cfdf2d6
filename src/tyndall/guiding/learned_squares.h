// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tyndall/math/vec.h"
#include "tyndall/sampling/tabulated.h"

namespace tyndall {

/// A point on one of several unit squares.
struct SquaresSample {
  size_t index;   ///< of the square
  Vec2 p;         ///< in [0, 1)^2
  float density;  ///< probability of the square times density of p on it
};

/// Unit squares that are sampled where samples have been worth most: each square is cut
/// into cells, and a cell is chosen in proportion to the root of the second moment of what
/// its samples found, which minimises variance [Rath20]. A fixed share is sampled as if
/// nothing had been learned.
///
/// Sums are integers, so that their order does not matter. record() may be called from many
/// threads; update() from one, while nothing else is called.
class LearnedSquares {
 public:
  /// One square per weight: the choice between squares before anything is learned, uniform
  /// on each. Weights as DiscreteDistribution takes them. With more squares, cells get
  /// larger, so that those of all take at most `max_bytes`; at the least one cell a square.
  LearnedSquares(std::span<const float> weights, size_t max_bytes);

  SquaresSample sample(float u_index, Vec2 u) const;
  /// What sample() calls `density`.
  float density(size_t index, Vec2 p) const;
  float probability(size_t index) const { return chosen_.probability(index); }

  /// A sample found `value`, already divided by its density, in units in which one is
  /// typical. Larger ones than 100 count as 100: one firefly must not decide.
  void record(const SquaresSample& sample, float value) const;
  /// Samples from what was recorded so far.
  void update() { learn(nullptr); }
  /// The same for a part of what `whole` records: as long as little was found here, it is
  /// taken to be alike. `whole` has the same weights, and cells that are no larger.
  void update(const LearnedSquares& whole) { learn(&whole); }

  size_t squares() const { return base_.size(); }
  int resolution() const { return resolution_; }  ///< cells per side of a square
  size_t memory() const;                          ///< [bytes]

 private:
  size_t cells() const;
  size_t cell(size_t index, int x, int y) const;
  size_t cell(size_t index, Vec2 p) const;
  void learn(const LearnedSquares* whole);
  void distribute(std::span<std::vector<float>> values, std::span<const double> totals,
                  double total);
  double scale_of(const LearnedSquares& whole) const;
  double moment(size_t index, int x, int y, int resolution) const;
  double total_moment() const;
  std::vector<float> roots(size_t index, const LearnedSquares* whole, double scale) const;
  float base_density(size_t index) const { return base_.probability(index); }

  DiscreteDistribution base_, chosen_;
  std::vector<PiecewiseConstant2D> learned_;  // of each square; empty before update()
  int resolution_;
  // Of each cell; the last: how many samples found something.
  std::unique_ptr<std::atomic<int64_t>[]> moments_;
};

}  // namespace tyndall
