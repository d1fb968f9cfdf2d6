// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/sky_guide.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {
namespace {

// The share of the samples that knows nothing.
constexpr float floor_share = 0.1f;
// Of what each of the six neighbours of a cell sees, in units of what it sees itself.
constexpr float from_neighbour = 0.125f;

constexpr size_t side = SkyGuide::side;

size_t stratum(float u) {
  return std::min(static_cast<size_t>(std::max(u, 0.0f) * SkyGuide::side), side - 1);
}

// Probabilities of strata that hold `counts` of all, the uniform share included.
template <typename Count>
std::array<float, side> probabilities(const std::array<Count, side>& counts) {
  float sum = 0;
  for (const Count c : counts) sum += static_cast<float>(c);
  std::array<float, side> p;
  for (size_t i = 0; i < side; ++i) {
    const float known = sum > 0 ? static_cast<float>(counts[i]) / sum : 1.0f / side;
    p[i] = floor_share / side + (1 - floor_share) * known;
  }
  return p;
}

template <typename Codes>
std::array<uint32_t, side> rows_of(const Codes& codes) {
  std::array<uint32_t, side> sums{};
  for (size_t y = 0; y < side; ++y)
    for (size_t x = 0; x < side; ++x) sums[y] += codes[y * side + x];
  return sums;
}

template <typename Codes>
std::array<uint32_t, side> row_of(const Codes& codes, size_t y) {
  std::array<uint32_t, side> row;
  for (size_t x = 0; x < side; ++x) row[x] = codes[y * side + x];
  return row;
}

// Where u falls among the strata, and how far into its own.
struct Fall {
  size_t index;
  float u;  // in [0, 1] of all
};

Fall fall(const std::array<float, side>& probabilities, float u) {
  size_t i = 0;
  for (; i + 1 < side && u >= probabilities[i]; ++i) u -= probabilities[i];
  const float offset = std::clamp(u / probabilities[i], 0.0f, one_minus_epsilon);
  const float x = (static_cast<float>(i) + offset) / SkyGuide::side;
  return {i, std::min(x, std::nextafter(static_cast<float>(i + 1) / SkyGuide::side, 0.0f))};
}

// Each stratum with its neighbours.
SkyGuide::Weights blurred(const SkyGuide::Weights& w) {
  SkyGuide::Weights out{};
  for (size_t y = 0; y < side; ++y)
    for (size_t x = 0; x < side; ++x)
      for (size_t j = y > 0 ? y - 1 : y; j <= std::min(y + 1, side - 1); ++j)
        for (size_t i = x > 0 ? x - 1 : x; i <= std::min(x + 1, side - 1); ++i)
          out[y * side + x] +=
              w[j * side + i] * (i == x ? 1.0f : 0.25f) * (j == y ? 1.0f : 0.25f);
  return out;
}

}  // namespace

SkyGuide::SkyGuide(const CellGrid& grid)
    : grid_(grid), seen_(grid.count()), codes_(grid.count() * strata) {}

void SkyGuide::set(size_t cell, const Weights& seen) {
  for (size_t i = 0; i < strata; ++i)
    seen_[cell][i] = seen[i] > 0 && seen[i] < infinity ? seen[i] : 0;
}

void SkyGuide::finish() {
  for (int z = 0; z < grid_.size(2); ++z)
    for (int y = 0; y < grid_.size(1); ++y)
      for (int x = 0; x < grid_.size(0); ++x)
        encode(grid_.index(x, y, z), blurred(spread(x, y, z)));
  seen_ = {};
}

SkyGuide::Weights SkyGuide::spread(int x, int y, int z) const {
  Weights sum = seen_[grid_.index(x, y, z)];
  for (int axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1}) {
      std::array<int, 3> at{x, y, z};
      int& moved = at[static_cast<size_t>(axis)];
      moved += step;
      if (moved < 0 || moved >= grid_.size(axis)) continue;
      const Weights& other = seen_[grid_.index(at[0], at[1], at[2])];
      for (size_t i = 0; i < strata; ++i) sum[i] += from_neighbour * other[i];
    }
  return sum;
}

void SkyGuide::encode(size_t cell, const Weights& weights) {
  const float most = *std::max_element(weights.begin(), weights.end());
  const float scale = most > 0 ? 255 / most : 0;
  for (size_t i = 0; i < strata; ++i)
    codes_[cell * strata + i] = static_cast<uint8_t>(std::ceil(weights[i] * scale));
}

Vec2 SkyGuide::sample(Vec3 p, Vec2 u) const {
  const Codes known = codes(p);
  const Fall y = fall(probabilities(rows_of(known)), u.y);
  const Fall x = fall(probabilities(row_of(known, y.index)), u.x);
  return {x.u, y.u};
}

float SkyGuide::pdf(Vec3 p, Vec2 u) const {
  const Codes known = codes(p);
  const size_t y = stratum(u.y);
  return float{strata} * probabilities(rows_of(known))[y] *
         probabilities(row_of(known, y))[stratum(u.x)];
}

}  // namespace tyndall
