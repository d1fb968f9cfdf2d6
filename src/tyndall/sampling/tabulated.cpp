// SPDX-License-Identifier: Apache-2.0
#include "tyndall/sampling/tabulated.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {
namespace {

double sum_of(std::span<const float> values) {
  double sum = 0;
  for (const float v : values) {
    assert(v >= 0 && std::isfinite(v));
    sum += double{v};
  }
  return sum;
}

// Inclusive sums of the values, normalised; the last is exactly one.
std::vector<float> inclusive_cdf(std::span<const float> values) {
  const double total = sum_of(values);
  const auto count = static_cast<double>(values.size());
  std::vector<float> cdf;
  cdf.reserve(values.size());
  double sum = 0;
  for (const float v : values) {
    sum += double{v};
    const auto share =
        total > 0 ? sum / total : static_cast<double>(cdf.size() + 1) / count;
    cdf.push_back(static_cast<float>(share));
  }
  return cdf;
}

// The first index whose inclusive sum exceeds u: never one of probability zero. Halves
// without jumps, which would be mispredicted half of the time.
size_t find_index(std::span<const float> cdf, float u) {
  u = std::min(u, one_minus_epsilon);
  const float* first = cdf.data();
  for (size_t left = cdf.size(); left > 1;) {
    const size_t half = left / 2;
    first += half & (size_t{0} - static_cast<size_t>(first[half - 1] <= u));
    left -= half;
  }
  return static_cast<size_t>(first - cdf.data());
}

// The bin of [0, 1] that holds x.
size_t find_bin(float x, size_t bins) {
  const float scaled = std::max(x, 0.0f) * static_cast<float>(bins);
  return std::min(static_cast<size_t>(scaled), bins - 1);
}

// The position at `offset` in [0, 1] of a bin; find_bin() of it is that bin despite
// rounding.
float position_in_bin(size_t bin, float offset, size_t bins) {
  float x = (static_cast<float>(bin) + offset) / static_cast<float>(bins);
  while (find_bin(x, bins) > bin) x = std::nextafter(x, 0.0f);
  while (find_bin(x, bins) < bin) x = std::nextafter(x, 1.0f);
  return std::min(x, one_minus_epsilon);
}

}  // namespace

DiscreteDistribution::DiscreteDistribution(std::span<const float> weights)
    : cdf_(inclusive_cdf(weights)) {}

DiscreteSample DiscreteDistribution::sample(float u) const {
  assert(!cdf_.empty());
  const size_t index = find_index(cdf_, u);
  const float below = index > 0 ? cdf_[index - 1] : 0;
  const float probability = cdf_[index] - below;
  return {index, probability,
          std::clamp((u - below) / probability, 0.0f, one_minus_epsilon)};
}

float DiscreteDistribution::probability(size_t index) const {
  assert(index < cdf_.size());
  return cdf_[index] - (index > 0 ? cdf_[index - 1] : 0);
}

PiecewiseConstant1D::PiecewiseConstant1D(std::span<const float> values)
    : densities_(values.begin(), values.end()), cdf_(inclusive_cdf(values)) {
  assert(!values.empty());
  const double mean = sum_of(values) / static_cast<double>(values.size());
  integral_ = static_cast<float>(mean);
  for (float& d : densities_) d = mean > 0 ? static_cast<float>(double{d} / mean) : 1;
}

PiecewiseSample PiecewiseConstant1D::sample(float u) const {
  const size_t bin = find_index(cdf_, u);
  const float below = bin > 0 ? cdf_[bin - 1] : 0;
  const float offset = std::clamp((u - below) / (cdf_[bin] - below), 0.0f, 1.0f);
  return {position_in_bin(bin, offset, cdf_.size()), densities_[bin]};
}

float PiecewiseConstant1D::pdf(float x) const {
  if (!(x >= 0 && x <= 1)) return 0;
  return densities_[find_bin(x, densities_.size())];
}

float PiecewiseConstant1D::invert(float x) const {
  const size_t bin = find_bin(x, cdf_.size());
  const float below = bin > 0 ? cdf_[bin - 1] : 0;
  const float offset = x * static_cast<float>(cdf_.size()) - static_cast<float>(bin);
  return std::clamp(below + offset * (cdf_[bin] - below), 0.0f, one_minus_epsilon);
}

PiecewiseConstant2D::PiecewiseConstant2D(std::span<const float> values, int width,
                                         int height) {
  assert(width > 0 && height > 0);
  assert(values.size() == static_cast<size_t>(width) * static_cast<size_t>(height));
  std::vector<float> integrals;
  for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
    const auto row = static_cast<size_t>(width);
    rows_.emplace_back(values.subspan(y * row, row));
    integrals.push_back(rows_.back().integral());
  }
  marginal_ = PiecewiseConstant1D(integrals);
}

size_t PiecewiseConstant2D::memory() const {
  size_t bytes = sizeof(*this) - sizeof(marginal_) + marginal_.memory();
  for (const PiecewiseConstant1D& row : rows_) bytes += row.memory();
  return bytes;
}

PiecewiseSample2D PiecewiseConstant2D::sample(Vec2 u) const {
  const PiecewiseSample y = marginal_.sample(u.y);
  const PiecewiseSample x = rows_[find_bin(y.x, rows_.size())].sample(u.x);
  return {{x.x, y.x}, x.pdf * y.pdf};
}

float PiecewiseConstant2D::pdf(Vec2 p) const {
  if (!(p.y >= 0 && p.y <= 1)) return 0;
  return marginal_.pdf(p.y) * rows_[find_bin(p.y, rows_.size())].pdf(p.x);
}

Vec2 PiecewiseConstant2D::invert(Vec2 p) const {
  return {rows_[find_bin(p.y, rows_.size())].invert(p.x), marginal_.invert(p.y)};
}

}  // namespace tyndall
