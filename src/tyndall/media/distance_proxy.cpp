// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/distance_proxy.h"

#include <algorithm>
#include <cmath>

#include "tyndall/math/scalar.h"
#include "tyndall/media/tracking.h"

namespace tyndall {

void DistanceProxy::add(const MediumSegment& s) {
  if (!(s.t_max > s.t_min)) return;
  const bool is_full = size_ == capacity;
  const size_t i = is_full ? size_ - 1 : size_++;
  for (int c = 0; c < channels_; ++c) {
    const size_t k = static_cast<size_t>(c);
    if (is_full) {
      const float sum =
          sigma_[k][i] * (t_max_[i] - t_min_[i]) + s.mean[c] * (s.t_max - s.t_min);
      sigma_[k][i] = sum / (s.t_max - t_min_[i]);
    } else {
      sigma_[k][i] = s.mean[c];
      depth_[k][i] = total_[c];
    }
  }
  if (!is_full) t_min_[i] = s.t_min;
  t_max_[i] = s.t_max;
  for (int c = 0; c < channels_; ++c) total_[c] = depth(c, i, t_max_[i] - t_min_[i]);
}

void DistanceProxy::finish() {
  int colliding = 0;
  for (int c = 0; c < channels_; ++c) colliding += total_[c] > 0 ? 1 : 0;
  for (int c = 0; c < channels_; ++c)
    if (total_[c] > 0)
      weight_[c] = -1 / (static_cast<float>(colliding) * std::expm1(-total_[c]));
}

size_t DistanceProxy::segment_at(float t) const {
  const auto end = t_max_.begin() + static_cast<std::ptrdiff_t>(size_);
  return static_cast<size_t>(std::lower_bound(t_max_.begin(), end, t) - t_max_.begin());
}

// The share of the density below the point at `length` into segment i.
double DistanceProxy::cdf(size_t i, float length) const {
  double sum = 0;
  for (int c = 0; c < channels_; ++c)
    if (weight_[c] > 0)
      sum -= double{weight_[c]} * std::expm1(-double{depth(c, i, length)});
  return sum;
}

// How far into segment i the cdf reaches u: Newton's method, kept within a shrinking
// bracket.
float DistanceProxy::solve(size_t i, double u) const {
  float low = 0, high = t_max_[i] - t_min_[i];
  float x = 0;
  for (int iteration = 0; iteration < 40; ++iteration) {
    const double error = cdf(i, x) - u;
    (error < 0 ? low : high) = x;
    const double slope = double{pdf_t(t_min_[i] + x)};
    float next = static_cast<float>(double{x} - error / slope);
    if (!(next >= low && next <= high))
      next = std::isinf(high) ? 2 * low + 1 : 0.5f * (low + high);
    if (magnitude(next - x) <= 1e-7f * next) return next;
    x = next;
  }
  return x;
}

std::optional<DistanceProxy::Sample> DistanceProxy::sample(float u) const {
  if (is_black(weight_)) return std::nullopt;
  size_t i = 0;
  float length = 0;
  if (channels_ == 1) {
    const float target = -std::log1p(-u / weight_.r);
    const auto begin = depth_[0].begin();
    i = static_cast<size_t>(
        std::upper_bound(begin, begin + static_cast<std::ptrdiff_t>(size_), target) -
        begin - 1);
    length = (target - depth_[0][i]) / sigma_[0][i];
  } else {
    size_t count = size_;
    while (count > 1) {
      const size_t half = count / 2;
      if (cdf(i + half, 0) <= double{u}) i += half;
      count -= half;
    }
    length = solve(i, double{u});
  }
  const float t = std::min(t_min_[i] + length, t_max_[i]);
  return Sample{.t = t, .pdf_t = pdf_t(t)};
}

float DistanceProxy::pdf_t(float t) const {
  const size_t i = segment_at(t);
  if (i == size_ || t < t_min_[i]) return 0;
  float sum = 0;
  for (int c = 0; c < channels_; ++c)
    if (weight_[c] > 0)
      sum += weight_[c] * sigma_[static_cast<size_t>(c)][i] *
             std::exp(-depth(c, i, t - t_min_[i]));
  return sum;
}

float DistanceProxy::invert(float t) const {
  const size_t i = segment_at(t);
  if (i == size_) return 1;
  return static_cast<float>(cdf(i, std::max(t - t_min_[i], 0.0f)));
}

Rgb DistanceProxy::optical_depth(float t) const {
  const size_t i = segment_at(t);
  if (i == size_) return spread(total_);
  Rgb sum;
  for (int c = 0; c < channels_; ++c) sum[c] = depth(c, i, std::max(t - t_min_[i], 0.0f));
  return spread(sum);
}

Rgb DistanceProxy::transmittance(float t) const { return exp(-1 * optical_depth(t)); }

Rgb DistanceProxy::sigma_t(float t) const {
  const size_t i = segment_at(t);
  if (i == size_ || t < t_min_[i]) return Rgb(0);
  return spread(
      {sigma_[0][i], channels_ == 1 ? 0 : sigma_[1][i], channels_ == 1 ? 0 : sigma_[2][i]});
}

float DistanceProxy::opacity() const { return 1 - average(exp(-1 * spread(total_))); }

}  // namespace tyndall
