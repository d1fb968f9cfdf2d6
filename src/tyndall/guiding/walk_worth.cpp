// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/walk_worth.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "tyndall/math/add_relaxed.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

constexpr size_t directions = 6;
constexpr float cells_wanted = 4096;
constexpr int max_size = 64;
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

WalkWorth::WalkWorth(const Bounds3& box) : box_(box) {
  assert(!box.is_empty());
  const Vec3 edges = box.diagonal();
  const float least = std::max(1e-3f * box.radius(), 1e-30f);
  const Vec3 d = max(edges, {least, least, least});
  const float edge = std::cbrt(d.x / cells_wanted) * std::cbrt(d.y) * std::cbrt(d.z);
  size_t cells = 1;
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<size_t>(i);
    size_[axis] = std::clamp(static_cast<int>(std::lround(d[i] / edge)), 1, max_size);
    cells *= static_cast<size_t>(size_[axis]);
    scale_[i] = static_cast<float>(size_[axis]) / d[i];
  }
  places_ = std::vector<Tally>(cells * directions);
}

size_t WalkWorth::place(Vec3 p, Vec3 w) const {
  size_t cell = 0;
  for (int i = 2; i >= 0; --i) {
    const int size = size_[static_cast<size_t>(i)];
    const float x = (p[i] - box_.min[i]) * scale_[i];
    const float inside = std::clamp(x, 0.0f, static_cast<float>(size - 1));
    cell = cell * static_cast<size_t>(size) + static_cast<size_t>(inside);
  }
  return cell * directions + direction(w);
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
