// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/learned_squares.h"

#include <algorithm>
#include <cmath>

#include "tyndall/math/add_relaxed.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

constexpr int max_resolution = 32;
// The share of samples that ignores what was learned: the price of being wrong.
constexpr float base_share = 0.2f;
// So many samples' worth of belief that a part is like the whole.
constexpr double prior_records = 16;
// Recorded squares are kept in these units.
constexpr double unit = 1e-6, largest = 1e4;

// The mean of a cell and its eight neighbours, the cell itself counting as much as all of
// them: neighbours know something of a cell that few samples have met.
float smoothed(const std::vector<float>& values, int n, int x, int y) {
  float sum = 0;
  int count = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, n - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, n - 1); ++i, ++count)
      sum += values[j * n + i];
  return 0.5f * (values[y * n + x] + sum / static_cast<float>(count));
}

}  // namespace

LearnedSquares::LearnedSquares(std::span<const float> weights, size_t max_bytes)
    : base_(weights), chosen_(base_), resolution_(max_resolution) {
  constexpr size_t cell_bytes = sizeof(int64_t) + 2 * sizeof(float);
  while (resolution_ > 1 &&
         weights.size() * cell_bytes * static_cast<size_t>(sqr(resolution_)) > max_bytes)
    resolution_ /= 2;
  moments_ = std::make_unique<std::atomic<int64_t>[]>(cells() + 1);
}

SquaresSample LearnedSquares::sample(float u_index, Vec2 u) const {
  const DiscreteSample chosen = chosen_.sample(u_index);
  if (learned_.empty()) return {chosen.index, u, chosen.probability};
  const PiecewiseSample2D s = learned_[chosen.index].sample(u);
  return {chosen.index, s.p, chosen.probability * s.pdf};
}

float LearnedSquares::density(size_t index, Vec2 p) const {
  return probability(index) * (learned_.empty() ? 1 : learned_[index].pdf(p));
}

size_t LearnedSquares::cells() const {
  return squares() * static_cast<size_t>(sqr(resolution_));
}

size_t LearnedSquares::cell(size_t index, int x, int y) const {
  return index * static_cast<size_t>(sqr(resolution_)) +
         static_cast<size_t>(y * resolution_ + x);
}

size_t LearnedSquares::cell(size_t index, Vec2 p) const {
  const auto coordinate = [&](float x) {
    return std::clamp(static_cast<int>(x * static_cast<float>(resolution_)), 0,
                      resolution_ - 1);
  };
  return cell(index, coordinate(p.x), coordinate(p.y));
}

void LearnedSquares::record(const SquaresSample& sample, float value) const {
  // value * density / base is what an unlearned sample would have found; the density over
  // the base once more makes its mean one over unlearned samples.
  const double moment =
      sqr(double{value}) * double{sample.density} / double{base_density(sample.index)};
  if (!(moment > 0)) return;
  add_relaxed(moments_[cells()], 1);
  add_relaxed(moments_[cell(sample.index, sample.p)],
              static_cast<int64_t>(std::min(moment, largest) / unit));
}

// Of a cell of the square cut more coarsely.
double LearnedSquares::moment(size_t index, int x, int y, int resolution) const {
  const int n = resolution_ / resolution;
  int64_t sum = 0;
  for (int j = y * n; j < (y + 1) * n; ++j)
    for (int i = x * n; i < (x + 1) * n; ++i) sum += moments_[cell(index, i, j)];
  return static_cast<double>(sum);
}

double LearnedSquares::total_moment() const {
  double sum = 0;
  for (size_t i = 0; i < cells(); ++i) sum += static_cast<double>(moments_[i].load());
  return sum;
}

// What turns moments of the whole into those of `prior_records` more samples.
double LearnedSquares::scale_of(const LearnedSquares& whole) const {
  const auto records = static_cast<double>(moments_[cells()].load());
  const double here = total_moment(), there = whole.total_moment();
  return here > 0 && there > 0 ? prior_records / records * here / there : 1;
}

// Per cell, what its probability should be in proportion to.
std::vector<float> LearnedSquares::roots(size_t index, const LearnedSquares* whole,
                                         double scale) const {
  const double base = double{base_density(index)};
  std::vector<float> roots;
  for (int y = 0; y < resolution_; ++y)
    for (int x = 0; x < resolution_; ++x) {
      double sum = moment(index, x, y, resolution_);
      if (whole) sum += scale * whole->moment(index, x, y, resolution_);
      roots.push_back(static_cast<float>(std::sqrt(base * sum)));
    }
  return roots;
}

void LearnedSquares::learn(const LearnedSquares* whole) {
  const size_t n = squares();
  const double prior = whole ? scale_of(*whole) : 0;
  std::vector<std::vector<float>> values(n);
  std::vector<double> totals(n);
  double total = 0;
  for (size_t i = 0; i < n; ++i) {
    const std::vector<float> raw = roots(i, whole, prior);
    values[i].resize(raw.size());
    for (int y = 0; y < resolution_; ++y)
      for (int x = 0; x < resolution_; ++x)
        values[i][y * resolution_ + x] = smoothed(raw, resolution_, x, y);
    for (const float v : values[i]) totals[i] += v;
    total += totals[i];
  }
  // If nothing was found, all stays as before.
  if (total > 0) distribute(values, totals, total);
}

// In proportion to values of the cells; their totals by square, and over all.
void LearnedSquares::distribute(std::span<std::vector<float>> values,
                                std::span<const double> totals, double total) {
  std::vector<float> weights(values.size());
  learned_.clear();
  for (size_t i = 0; i < values.size(); ++i) {
    const double learned = (1 - base_share) * totals[i] / total;
    const double base = base_share * double{base_density(i)};
    weights[i] = static_cast<float>(learned + base);
    // Within the square, so that the share of the base is the same over all squares.
    const double scale = (1 - base_share) / total;
    for (float& v : values[i])
      v = static_cast<float>(scale * v + base / static_cast<double>(values[i].size()));
    learned_.emplace_back(values[i], resolution_, resolution_);
  }
  chosen_ = DiscreteDistribution(weights);
}

size_t LearnedSquares::memory() const {
  size_t bytes =
      (cells() + 1) * sizeof(int64_t) + (base_.size() + chosen_.size()) * sizeof(float);
  for (const PiecewiseConstant2D& square : learned_) bytes += square.memory();
  return bytes;
}

}  // namespace tyndall
