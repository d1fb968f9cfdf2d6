// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// The non-empty stretches of a ray, with an intensity of sampling on each: a compact
/// coordinate in which combs of equidistant samples estimate optical depth.
class MarchingStrata {
 public:
  static constexpr size_t capacity = 128;

  void add(const MediumSegment& s) {
    const float length = s.t_max - s.t_min;
    if (!(length > 0)) return;
    majorant_depth_ += max_component(s.majorant) * length;
    const bool is_full = size_ == capacity;
    const size_t i = is_full ? size_ - 1 : size_++;
    if (!is_full) t_min_[i] = s.t_min;
    // Means place the samples well; the majorants bound the weights.
    const float intensity = std::max(average(s.mean), majorant_share * average(s.majorant));
    const float sum = intensity * length + (is_full ? end_[i] - begin_of(i) : 0);
    intensity_[i] = sum / (s.t_max - t_min_[i]);
    end_[i] = begin_of(i) + sum;
  }

  bool is_empty() const { return size_ == 0; }
  float total() const {
    return size_ == 0 ? 0 : end_[size_ - 1];
  }  ///< integral of intensity
  float majorant_depth() const { return majorant_depth_; }

  /// Unbiased optical depth by one comb of `count` samples shifted by `u`.
  template <typename Segments>
  Rgb march(const Segments& segments, int count, float u) const {
    Rgb sum;
    size_t i = 0;
    const float spacing = total() / static_cast<float>(count);
    for (int k = 0; k < count; ++k) {
      const float x = (static_cast<float>(k) + u) * spacing;
      while (i + 1 < size_ && x >= end_[i]) ++i;
      const float t = t_min_[i] + (x - begin_of(i)) / intensity_[i];
      sum += segments.sigma_t_anywhere(t) / intensity_[i];
    }
    return sum * spacing;
  }

 private:
  static constexpr float majorant_share = 0.1f;

  float begin_of(size_t i) const { return i == 0 ? 0 : end_[i - 1]; }

  std::array<float, capacity> t_min_, intensity_;
  std::array<float, capacity> end_;  // integral of the intensity up to each stretch's end
  size_t size_ = 0;
  float majorant_depth_ = 0;
};

/// A number of combs to spend on the power series, and the probability to reach each order.
struct SeriesOrder {
  static constexpr int max = 32;  ///< beyond reach: it has a probability of 1e-27
  int order;
  std::array<float, max + 1> reach;  ///< P(order >= k), for k up to `order`
};

/// Order 0 in nine of ten cases, else 2 and more [BK85], [KdPN21].
inline SeriesOrder sample_series_order(RandomStream& rng) {
  constexpr float p_more = 0.1f;
  SeriesOrder s;
  s.order = 0;
  s.reach[0] = 1;
  if (rng.next_1d() >= p_more) return s;
  s.reach[1] = s.reach[2] = p_more;
  s.order = 2;
  while (s.order < SeriesOrder::max) {
    const float p_next = 2.0f / static_cast<float>(s.order + 1);
    if (rng.next_1d() >= p_next) break;
    ++s.order;
    s.reach[static_cast<size_t>(s.order)] =
        s.reach[static_cast<size_t>(s.order - 1)] * p_next;
  }
  return s;
}

/// exp(-X) for the mean X of independent unbiased estimates `x`: the power series about
/// each of them in turn, its terms by U-statistics of the others, averaged [KdPN21].
inline float exponential_of_mean(const float* x, const SeriesOrder& series) {
  const int n = series.order;
  double sum = 0;
  for (int pivot = 0; pivot <= n; ++pivot) {
    // means[k]: the elementary symmetric mean of order k of the differences so far.
    std::array<double, SeriesOrder::max + 1> means{1};
    int seen = 0;
    for (int i = 0; i <= n; ++i) {
      if (i == pivot) continue;
      ++seen;
      const double difference = double{x[pivot]} - double{x[i]};
      for (int k = seen; k >= 1; --k) {
        const size_t at = static_cast<size_t>(k);
        const double share = static_cast<double>(k) / seen;
        means[at] += share * (difference * means[at - 1] - means[at]);
      }
    }
    double factorial = 1, terms = 0;
    for (int k = 0; k <= n; ++k) {
      if (k > 0) factorial *= k;
      terms += means[static_cast<size_t>(k)] /
               (factorial * double{series.reach[static_cast<size_t>(k)]});
    }
    sum += terms * std::exp(-double{x[pivot]});
  }
  return static_cast<float>(sum / (n + 1));
}

/// Samples of a comb for an optical depth of the majorants [KdPN21, Sec. 5].
inline int comb_size(float majorant_depth) {
  const float d = majorant_depth;
  const float samples = std::cbrt((0.015f + d) * (0.65f + d) * (60.3f + d)) / 1.32f;
  return std::clamp(static_cast<int>(std::lround(samples)), 1, 128);
}

/// Unbiased transmittance up to t_max by ray marching with jittered combs [KdPN21]: low
/// variance, but now and then below zero or above one.
template <typename M>
Rgb unbiased_ray_marching(const M& medium, const Ray& ray, float t_max, RandomStream& rng) {
  auto segments = medium.segments(ray, t_max);
  MarchingStrata strata;
  MediumSegment s;
  while (segments.next(s)) strata.add(s);
  if (strata.is_empty()) return Rgb(1);

  const int count = comb_size(strata.majorant_depth());
  const SeriesOrder series = sample_series_order(rng);
  std::array<std::array<float, SeriesOrder::max + 1>, 3> depths;
  const int channels = medium.is_grey() ? 1 : 3;
  for (size_t i = 0; i <= static_cast<size_t>(series.order); ++i) {
    const Rgb depth = strata.march(segments, count, rng.next_1d());
    for (int c = 0; c < channels; ++c) depths[static_cast<size_t>(c)][i] = depth[c];
  }
  Rgb result;
  for (int c = 0; c < channels; ++c)
    result[c] = exponential_of_mean(depths[static_cast<size_t>(c)].data(), series);
  return channels == 1 ? Rgb(result.r) : result;
}

}  // namespace tyndall
