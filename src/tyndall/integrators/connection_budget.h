// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace tyndall {

/// What a path can spend rays on besides walking.
enum class Effort { single, dual, lit_from_leg, lit_from_vertex, glow };

/// How often each connection is made, by kind and by how far along the path: as often as
/// its variance is worth its rays, by measurement on the render's first samples.
///
/// With variance V and cost C of the walk, and M and c of one connection, the product of
/// the variance and the cost of a path is least for M / c * C / V connections squared. M is
/// the variance given the walk: half the squared difference of two connections made at one
/// place.
///
/// Sums are integers, so that their order does not matter: the same counts with any number
/// of threads. record() may be called from many threads; update() from one, while no other
/// runs.
class ConnectionBudget {
 public:
  /// `mean_radiance` of the picture, roughly.
  explicit ConnectionBudget(float mean_radiance);

  /// In units of the mean radiance.
  float relative(float radiance) const { return radiance * static_cast<float>(scale_); }

  /// How many connections to make; fractions are probabilities.
  float count(Effort effort, int depth) const { return cell(effort, depth).count; }

  /// Two independent connections at one place gave these values.
  void record_pair(Effort effort, int depth, float a, float b) const;
  /// A path with so many legs ended, having found `value` by its walk and next event
  /// estimation.
  void record_walk(float value, int legs) const;

  /// Recomputes the counts from all that was recorded.
  void update();

 private:
  static constexpr int depths = 6;  // the last stands for all beyond
  static constexpr size_t efforts = 5;

  struct Cell {
    float count = 2;  // two, until something is known
    mutable std::atomic<int64_t> variance = 0, pairs = 0;
  };
  const Cell& cell(Effort effort, int depth) const;

  double scale_;
  std::array<Cell, efforts * depths> cells_;
  mutable std::atomic<int64_t> walk_square_ = 0, walks_ = 0, legs_ = 0;
};

}  // namespace tyndall
