// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "tyndall/math/elementary.h"
#include "tyndall/techniques/distance_taps.h"
#include "tyndall/techniques/pivot_segment.h"
#include "tyndall/techniques/samples.h"
#include "tyndall/techniques/scattering_tables.h"

namespace tyndall {

/// Draws the first of two scattering vertices on a ray, with density proportional to the
/// light of a point source at `pivot` that, scattered once more on its way, arrives there
/// and is scattered along the ray, without transmittance and visibility: F(alpha) / D, D
/// the distance to the pivot and alpha its angle from the ray [Georgiev13]. In isotropic
/// media that is 1 / D, uniform in l = asinh(s / h) = log(tan(alpha / 2)).
///
/// A value, built once per ray and pivot; `ray.d` is unit length. The stretch must be
/// finite, as the integral grows with its logarithm. `tables` must outlive it.
class DoubleScatteringDistance {
 public:
  DoubleScatteringDistance(const ScatteringTables& tables, const Ray& ray, Vec3 pivot,
                           float t_min, float t_max)
      : DoubleScatteringDistance(tables, PivotSegment(ray, pivot, t_min, t_max)) {}
  DoubleScatteringDistance(const ScatteringTables& tables, const PivotSegment& segment)
      : segment_(segment) {
    if (!segment_.is_proper() || !(segment_.length() < infinity)) return;
    const float s = segment_.s_near(), r = segment_.r_near();
    plus_near_ = segment_.plus(s, r);
    length_ = density_or_zero(log_way(segment_.length()));
    if (!tables.is_isotropic()) {
      const float l = std::copysign(log_of((r + magnitude(s)) / segment_.h()), s);
      fluence_ = tables.fluence().cursor(l * segment_.sign(), segment_.sign());
      is_tabulated_ = true;
    }
    integral_ = density_or_zero(is_tabulated_ ? fluence_.integral(length_) : length_);
  }

  /// The integral of F(alpha) / D over the stretch, F = 1 in isotropic media. Zero if
  /// empty.
  float integral() const { return integral_; }

  /// Empty if the stretch is empty, infinite, or runs through the pivot. t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    if (!(integral_ > 0)) return std::nullopt;
    const float part = segment_.from_near(u) * integral_;
    const float way = is_tabulated_ ? fluence_.invert(part) : part;
    // s = ((r + s) - (r - s)) / 2, where r + s grows by the factor e^way.
    const float growth = exp_minus_1(way);
    const float minus_near = segment_.minus(segment_.s_near(), segment_.r_near());
    const float t = segment_.t(0.5f * growth * (plus_near_ + minus_near / (1 + growth)));
    const float pdf = pdf_t(t);
    if (!(pdf > 0)) return std::nullopt;
    return DistanceSample{.t = t, .pdf_t = pdf};
  }

  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const {
    if (!(integral_ > 0) || !segment_.contains(t)) return 0;
    const float offset = segment_.offset(t);
    const float f = is_tabulated_ ? fluence_.value(log_way(offset)) : 1;
    return density_or_zero(f / (integral_ * segment_.r(segment_.s(offset))));
  }

  /// The u that sample() maps to t, in [0, 1]; zero if the technique is empty.
  float invert(float t) const {
    if (!(integral_ > 0)) return 0;
    const float way = log_way(std::clamp(segment_.offset(t), 0.0f, segment_.length()));
    const float part = is_tabulated_ ? fluence_.integral(way) : way;
    return segment_.from_near(std::min(part / integral_, 1.0f));
  }

  /// The points at u = (i + 1/2) / K of the isotropic technique; t to about 1e-5 of its
  /// range.
  template <int K>
  DistanceTaps<K> taps() const;

  const PivotSegment& segment() const { return segment_; }

 private:
  /// l at an offset minus l at the near end: the logarithm of the ratio of r + s. Its
  /// growth is written as a quotient in which nothing cancels.
  float log_way(float offset) const {
    const float s = segment_.s(offset);
    return log_of_1_plus(2 * offset / (segment_.minus(s, segment_.r(s)) + plus_near_));
  }

  PivotSegment segment_;
  LinearTable::Cursor fluence_;
  float plus_near_ = 0;  // r + s at the near end
  float length_ = 0, integral_ = 0;
  bool is_tabulated_ = false;
};

template <int K>
[[gnu::always_inline]] inline DistanceTaps<K> DoubleScatteringDistance::taps() const {
  // r + s is a geometric sequence; each tap is the product of one of the first eight and
  // the power of one ratio.
  constexpr int lanes = 8;
  static_assert(K % lanes == 0);
  const float sign = segment_.sign();
  const float step = length_ / K;
  const float half_step = std::exp(sign * 0.5f * step), one_step = half_step * half_step;
  float ratio[lanes];  // of r + s to that of the near end
  ratio[0] = (segment_.is_forward() ? 1 : std::exp(length_)) * half_step;
  float turn = one_step;
  for (int width = 1; width < lanes; width *= 2, turn *= turn)
    for (int i = 0; i < width; ++i) ratio[width + i] = ratio[i] * turn;
  DistanceTaps<K> taps;
  std::array<float, K>& x = taps.t;
  std::copy(ratio, ratio + lanes, x.begin());
  for (int k = 0; k + lanes < K; ++k) x[k + lanes] = x[k] * turn;
  const float plus = 0.5f * plus_near_;
  const float minus = 0.5f * segment_.minus(segment_.s_near(), segment_.r_near());
  const float t_near = segment_.t_near(), s_near = segment_.s_near();
  for (int k = 0; k < K; ++k) {
    const float p = plus * x[k], m = minus / x[k], s = p - m, r = p + m;
    taps.distance[k] = r;
    taps.cos_alpha[k] = -sign * s / r;
    taps.t[k] = t_near + sign * (s - s_near);
  }
  return taps;
}

}  // namespace tyndall
