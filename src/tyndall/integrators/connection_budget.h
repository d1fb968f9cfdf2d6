// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "tyndall/integrators/pixel_sums.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// What a path can spend rays on besides walking.
enum class Effort { single, dual, lit_from_leg, lit_from_vertex, glow, forced };
inline constexpr uint32_t effort_count = 6;

/// Connections of one kind are made at most so often at one place.
inline constexpr uint32_t most_of_a_kind = 4;

/// Where a connection may be made.
struct ConnectionPlace {
  size_t region;
  Effort effort;
  int depth;  ///< scattering vertices before it
  /// What it is predicted to find, in a unit of its kind; zero if unknown.
  float predicted = 0;
};

/// The most regions that a budget divides a picture into, and what lit_place() has of it.
inline constexpr size_t max_regions = 64, lit_places = 1 + 2 * max_regions;

/// How often each connection is made, by kind, by how far along the path and by region of
/// the picture: as often as its variance is worth its rays, by measurement on the render's
/// first samples. What counts is the variance relative to the squared radiance of the
/// region.
///
/// With V the variance of a path, C its cost, M the variance of one connection given the
/// walk (half the squared difference of two made at one place) and c its cost, the product
/// of V and C is least for sqrt(M / c * C / V) connections. Where that is less than one, a
/// connection left to chance varies by all that it finds, and M is the mean of its square.
/// Within a region M and V hold for places of typical predictions. Where more is predicted
/// than that, connections are more, or else what is found there rarely would be worth most;
/// where less is, they are not fewer by much: predictions may be wrong.
///
/// Where connections as a whole cost more than they gain, none are to be made: pays(). What
/// plain paths have not found at all of what paths with connections find must be found by
/// less than one of them: that much they vary at least.
///
/// Sums are integers, so that their order does not matter: the same counts with any number
/// of threads. record() may be called from many threads; update() from one, while no other
/// runs.
class ConnectionBudget {
 public:
  /// `mean_radiance` of the picture, roughly; its size in pixels; what connections cost
  /// altogether, in units of what their rays cost; and the efficiency that they must have
  /// not to be given up, that of plain paths being one. Their variance is taken for as
  /// large as it may well be.
  ConnectionBudget(float mean_radiance, Vec2i resolution, double overhead = 1,
                   double least_efficiency = 0.85);

  /// The region of a pixel; any pixel has one.
  size_t region(Vec2i pixel) const;

  /// In units of the mean radiance.
  float relative(float radiance) const { return radiance * static_cast<float>(scale_); }

  /// How many connections to make at typical places; fractions are probabilities.
  float count(size_t region, Effort effort, int depth) const {
    return counts_[region][cell(effort, depth)];
  }
  /// The same for this place.
  float count(const ConnectionPlace& place) const;

  /// A path came to the place, whether it makes connections or not.
  void record_place(const ConnectionPlace& place) const;
  /// A connection found `value`: the first one that was made there.
  void record(const ConnectionPlace& place, float value) const;
  /// Two connections at one place found values of this half squared difference.
  void record_pair(const ConnectionPlace& place, float half_squared_difference) const;
  /// What so many connections cost [rays].
  static float cost(Effort effort, int count);
  /// A path ended.
  struct Finished {
    float value;  ///< that it found
    int legs;
    float spent = 0;      ///< cost() of its connections
    float lit_gain = 0;   ///< lit_gain() of its connections to lit surfaces
    float lit_spent = 0;  ///< cost() of them
  };
  /// How much more the square of what a path finds would be without a connection to a lit
  /// surface that is made `count` times, found `value`, and got the weight `share` of the
  /// balance heuristic, see TailCounts: what else finds the same path then does so alone.
  static float lit_gain(float value, float share, float count) {
    const float others = std::max(1 - share, 1e-6f);
    return value * value * ((2 - share) / (others * std::max(count, 1.0f)) - 1 / count);
  }
  void record_path(Vec2i pixel, const Finished& path) const;
  /// A path without any connections ended.
  void record_plain_path(size_t region, const Finished& path) const;

  /// Recomputes the counts from all that was recorded. Decides pays(), once, as soon as
  /// there are plain paths to compare the paths since the last update with: of two samples
  /// of what is rare the larger seems to vary more, so later and larger ones are not asked.
  void update();
  /// Nothing more needs to be recorded.
  void end_recording() { is_recording_ = false; }
  bool is_recording() const { return is_recording_; }
  /// False if connections are known to be of no use: the worst of a path tracer's variance,
  /// lights within reach of its vertices, takes more than a few paths to be seen.
  bool pays() const { return pays_; }
  /// The same for connections to lit surfaces alone.
  bool lit_pays() const { return lit_pays_; }

  /// What a path costs [rays] that has so many legs and spent so much, by cost(), on
  /// connections.
  float path_cost(int legs, float spent) const;
  /// Radiance in units of that of the region, as squares are weighed. Of what is known at
  /// the last update.
  float relative(size_t region, float radiance) const {
    return radiance * region_scales_[region];
  }
  /// Variance of the paths of a pixel, relative to the squared radiance of its region, over
  /// their cost: of the paths between the last two updates.
  double price() const { return price_; }

  /// Mean over the picture.
  double mean_count(Effort effort, int depth) const;

 private:
  static constexpr size_t efforts = effort_count;
  static constexpr size_t depths = 6;  // the last stands for all beyond
  static size_t cell(Effort effort, int depth) {
    const auto d = static_cast<size_t>(depth);
    return static_cast<size_t>(effort) * depths + (d < depths ? d : depths - 1);
  }

  struct Cell {
    std::atomic<int64_t> squares = 0, visits = 0, variance = 0, pairs = 0;
    // Of predictions: how many, their logarithms, and the factors that they led to.
    std::atomic<int64_t> predictions = 0, logarithms = 0, factors = 0;
  };
  struct Tally {
    std::atomic<int64_t> values = 0, squares = 0, paths = 0, cost = 0;
    std::atomic<int64_t> lit_gain = 0, lit_cost = 0;
  };
  struct Region {
    std::array<Cell, efforts * depths> cells;
    std::atomic<int64_t> radiance = 0, paths = 0;
    Tally recent, plain;
    std::atomic<int64_t> plain_fourths = 0;
  };
  // Mean variance and cost of a path.
  struct Efficiency {
    double mean, variance, cost, paths, lit_gain, lit_cost;
  };
  struct Worth;  // of a square that is recorded in a region
  Worth worth() const;
  void update_cell(size_t cell, const Worth& worth);
  double update_typical(size_t cell);
  float factor(const ConnectionPlace& place) const;
  Efficiency efficiency(Tally Region::*tally, const Worth& worth) const;
  double variance_in_pixels(const Worth& worth) const;
  double standard_error(const Worth& worth, double paths) const;
  void decide(const Worth& worth);

  double overhead_, least_efficiency_, scale_, price_ = 0;
  Vec2i resolution_, size_;
  bool is_recording_ = true, is_decided_ = false, pays_ = true, lit_pays_ = true;
  mutable std::vector<Region> regions_;
  PixelSums recent_;
  // Of typical predictions: connections, how many if each found its mean square, and the
  // predictions.
  std::vector<std::array<float, efforts * depths>> counts_, by_squares_, typical_;
  std::vector<float> region_scales_;
};

/// How often the connections of one path are made: once each, where there is no budget.
class ConnectionCounts {
 public:
  ConnectionCounts() = default;
  /// The budget must outlive this.
  ConnectionCounts(const ConnectionBudget& budget, Vec2i pixel)
      : budget_(&budget), region_(budget.region(pixel)) {}

  size_t region() const { return region_; }
  /// Number of the place that a connection to a lit surface is made from: a region, for
  /// those from the first leg, and for those from the vertex at its end; zero for all
  /// others.
  size_t lit_place(Effort effort, int depth) const {
    const bool is_from_leg = effort == Effort::lit_from_leg;
    return depth == (is_from_leg ? 0 : 1) ? 1 + 2 * region_ + (is_from_leg ? 0 : 1) : 0;
  }
  /// At typical places.
  float operator()(Effort effort, int depth) const {
    return budget_ ? budget_->count(region_, effort, depth) : 1;
  }
  float operator()(const ConnectionPlace& place) const {
    return budget_ ? budget_->count(place) : 1;
  }

 private:
  const ConnectionBudget* budget_ = nullptr;
  size_t region_ = 0;
};

}  // namespace tyndall
