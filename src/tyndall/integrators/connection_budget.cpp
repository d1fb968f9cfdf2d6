// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/connection_budget.h"

#include <algorithm>
#include <cmath>

#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

// Rays that one connection, and one leg of the walk with its next event estimation, cost.
constexpr std::array<double, 5> effort_cost{2, 4, 4, 3, 4};
constexpr double leg_cost = 2.5;

// The walk's variance is mostly that of bright pixels; dark ones need their connections
// too, and most of what they see happens on the first leg.
constexpr float min_count_first = 1, min_count_later = 0.25f, max_count = 4;

// Recorded squares, relative to that of the mean radiance, are kept in these units and
// clamped: one firefly must not decide.
constexpr double unit = 1e-8, largest = 1e4;

int64_t quantize(double square) {
  return std::isfinite(square) ? static_cast<int64_t>(std::min(square, largest) / unit) : 0;
}

}  // namespace

ConnectionBudget::ConnectionBudget(float mean_radiance)
    : scale_(mean_radiance > 0 ? 1 / mean_radiance : 1) {}

const ConnectionBudget::Cell& ConnectionBudget::cell(Effort effort, int depth) const {
  return cells_[static_cast<size_t>(effort) * depths +
                static_cast<size_t>(std::clamp(depth, 0, depths - 1))];
}

void ConnectionBudget::record_pair(Effort effort, int depth, float a, float b) const {
  const Cell& c = cell(effort, depth);
  const double difference = (double{a} - double{b}) * scale_;
  c.variance.fetch_add(quantize(0.5 * difference * difference), std::memory_order_relaxed);
  c.pairs.fetch_add(1, std::memory_order_relaxed);
}

void ConnectionBudget::record_walk(float value, int legs) const {
  walk_square_.fetch_add(quantize(sqr(double{value} * scale_)), std::memory_order_relaxed);
  walks_.fetch_add(1, std::memory_order_relaxed);
  legs_.fetch_add(legs, std::memory_order_relaxed);
}

void ConnectionBudget::update() {
  const auto walks = static_cast<double>(std::max<int64_t>(walks_, 1));
  const double walk_variance = static_cast<double>(walk_square_) * unit / walks;
  const double walk_cost = leg_cost * static_cast<double>(legs_) / walks;
  for (size_t i = 0; i < cells_.size(); ++i) {
    Cell& c = cells_[i];
    if (c.pairs == 0) continue;
    const double variance =
        static_cast<double>(c.variance) * unit / static_cast<double>(c.pairs);
    const double worth = variance / effort_cost[i / depths];
    const double price = walk_variance / std::max(walk_cost, 1e-9);
    const double count = price > 0 ? std::sqrt(worth / price) : 1;
    const float least = i % depths == 0 ? min_count_first : min_count_later;
    c.count = std::clamp(static_cast<float>(count), least, max_count);
  }
}

}  // namespace tyndall
