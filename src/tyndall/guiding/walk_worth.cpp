// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/walk_worth.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "tyndall/math/add_relaxed.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

constexpr size_t directions = 6;
constexpr int cells_wanted = 4096;
// Walks' worth of belief that a place is like what it is part of.
constexpr double prior_walks = 32;
// What varies most is seen least: second moments are taken for twice what they seem.
constexpr double caution = 2;

constexpr double square_unit = 1e-6, largest_square = 1e4, cost_unit = 1.0 / 16;

// The axis along which w is longest, and its sign.
size_t direction(Vec3 w) {
  int axis = std::abs(w.x) > std::abs(w.y) ? 0 : 1;
  if (std::abs(w.z) > std::abs(w[axis])) axis = 2;
  return 2 * static_cast<size_t>(axis) + (w[axis] > 0 ? 1 : 0);
}

struct Sums {
  double squares = 0, cost = 0, walks = 0;

  void add(const Sums& s) {
    squares += s.squares;
    cost += s.cost;
    walks += s.walks;
  }
  Sums with_prior(const Sums& whole) const {
    const double share = prior_walks / whole.walks;
    return {squares + share * whole.squares, cost + share * whole.cost,
            walks + prior_walks};
  }
};

template <typename Tally>
Sums sums(const Tally& tally) {
  return {static_cast<double>(tally.squares) * square_unit,
          static_cast<double>(tally.cost) * cost_unit, static_cast<double>(tally.walks)};
}

}  // namespace

WalkWorth::WalkWorth(const Bounds3& box)
    : grid_(box, cells_wanted), places_(grid_.count() * directions) {}

size_t WalkWorth::place(Vec3 p, Vec3 w) const {
  return grid_.find(p) * directions + direction(w);
}

void WalkWorth::record(size_t place, float value, float cost) const {
  const double square = sqr(double{value});
  if (!std::isfinite(square) || !(cost >= 0)) return;
  Tally& tally = places_[place];
  add_relaxed(tally.squares,
              static_cast<int64_t>(std::min(square, largest_square) / square_unit));
  add_relaxed(tally.cost, static_cast<int64_t>(double{cost} / cost_unit));
  add_relaxed(tally.walks, 1);
}

void WalkWorth::clear() {
  for (Tally& tally : places_) tally.squares = tally.cost = tally.walks = 0;
  survivals_.clear();
}

void WalkWorth::update(double price) {
  Sums all;
  for (const Tally& tally : places_) all.add(sums(tally));
  if (!(all.squares > 0 && all.cost > 0 && price > 0)) return;
  survivals_.resize(places_.size());
  for (size_t first = 0; first < places_.size(); first += directions) {
    const std::span<const Tally> tallies(&places_[first], directions);
    Sums cell;
    for (const Tally& tally : tallies) cell.add(sums(tally));
    cell = cell.with_prior(all);
    for (size_t i = 0; i < directions; ++i) {
      const Sums here = sums(tallies[i]).with_prior(cell);
      survivals_[first + i] =
          static_cast<float>(std::sqrt(caution * here.squares / (here.cost * price)));
    }
  }
}

size_t WalkWorth::memory() const {
  return places_.size() * sizeof(Tally) + survivals_.size() * sizeof(float);
}

}  // namespace tyndall
