// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "tyndall/math/elementary.h"
#include "tyndall/techniques/distance_taps.h"
#include "tyndall/techniques/pivot_segment.h"
#include "tyndall/techniques/samples.h"

namespace tyndall {

/// The integral of 1 / D^2 from the near end of a stretch to an offset: the angle under
/// which the pivot sees it, over h. As the arc tangent of a quotient of products it keeps
/// its relative precision for small angles, and is defined for h = 0.
inline float inverse_square_integral(const PivotSegment& segment, float offset) {
  const double h = segment.h(), s0 = segment.s_near();
  const bool is_finite = offset < infinity;
  const double cosine = is_finite ? h * h + s0 * (s0 + offset) : s0;
  const double sine_over_h = is_finite ? offset : 1, sine = h * sine_over_h;
  const double run = std::abs(cosine);
  const auto slope = static_cast<float>(std::min(sine, run) / std::max(sine, run));
  const auto tangent_over_h = static_cast<float>(sine_over_h / run);
  const auto flatness = static_cast<float>(run - sine), ahead = static_cast<float>(cosine);
  const float inverse_h = 1 / segment.h(), half_turn = pi * inverse_h;
  // From the direction of the near end, from the one back, or from the one across.
  const float from = by_sign(flatness, by_sign(ahead, 0, half_turn), 0.5f * half_turn);
  const float arc =
      arc_tangent_over(slope) * by_sign(flatness, tangent_over_h, slope * inverse_h);
  return from + flip_sign(arc, flatness, ahead);
}

/// The offset up to which inverse_square_integral() is `part`: the near end's direction
/// from the pivot turned by the angle h * part.
inline float inverse_square_offset(const PivotSegment& segment, float part) {
  const float half_part = 0.5f * part, half = segment.h() * half_part;
  const float square = half * half;
  const float sine_over_h = half_part * sine_over(square);  // of half the angle
  const float cosine = cosine_by_square(square);
  const float turn_over_h = 2 * sine_over_h * cosine;
  const float end = 1 - 2 * sqr(segment.h() * sine_over_h) - segment.s_near() * turn_over_h;
  if (!(end > 0)) return segment.length();
  const float r = segment.r_near();
  return std::min(r * turn_over_h * (r / end), segment.length());
}

/// Draws distances in [t_min, t_max] with density proportional to the inverse squared
/// distance to `pivot`, usually a point on a light [KF12]: single scattering without its
/// phase function.
///
/// A value, built once per ray and pivot; `ray.d` is unit length, t_max may be infinite.
/// The pivot may lie anywhere but on the stretch itself; there the technique is empty.
class EquiangularSampling {
 public:
  EquiangularSampling(const Ray& ray, Vec3 pivot, float t_min, float t_max)
      : EquiangularSampling(PivotSegment(ray, pivot, t_min, t_max)) {}
  explicit EquiangularSampling(const PivotSegment& segment) : segment_(segment) {
    if (segment_.is_proper())
      integral_ = density_or_zero(inverse_square_integral(segment_, segment_.length()));
  }

  /// The integral of the inverse squared distance over the stretch [1/scene unit]: what the
  /// weight of a sample is where nothing else varies. Zero if the technique is empty.
  float integral() const { return integral_; }

  /// Empty if the stretch is empty or runs through the pivot. t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    if (!(integral_ > 0)) return std::nullopt;
    const float t =
        segment_.t(inverse_square_offset(segment_, segment_.from_near(u) * integral_));
    const float pdf = pdf_t(t);
    if (!(pdf > 0)) return std::nullopt;
    return DistanceSample{.t = t, .pdf_t = pdf};
  }

  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const {
    if (!(integral_ > 0) || !segment_.contains(t)) return 0;
    const float s = segment_.s(segment_.offset(t));
    return density_or_zero(1 / (integral_ * (sqr(segment_.h()) + sqr(s))));
  }

  /// The u that sample() maps to t, in [0, 1]; zero if the technique is empty.
  float invert(float t) const {
    if (!(integral_ > 0)) return 0;
    const float offset = std::clamp(segment_.offset(t), 0.0f, segment_.length());
    return segment_.from_near(
        std::min(inverse_square_integral(segment_, offset) / integral_, 1.0f));
  }

  /// The points at u = (i + 1/2) / K; t to about 1e-5 of its range.
  template <int K>
  DistanceTaps<K> taps() const;

  const PivotSegment& segment() const { return segment_; }

 private:
  PivotSegment segment_;
  float integral_ = 0;
};

template <int K>
[[gnu::always_inline]] inline DistanceTaps<K> EquiangularSampling::taps() const {
  // The unit vector from the pivot turns by equal angles from tap to tap: the first eight
  // by doubling, the rest by turning eight together. Sines are kept over h, which may be
  // zero.
  constexpr int lanes = 8;
  static_assert(K % lanes == 0 && K >= 16);
  struct Turn {
    float cosine, sine;
    Turn then(Turn b, float h2) const {
      return {cosine * b.cosine - h2 * sine * b.sine, sine * b.cosine + cosine * b.sine};
    }
  };
  const float h = segment_.h(), s0 = segment_.s_near(), r0 = segment_.r_near(), h2 = h * h;
  const float sign = segment_.sign();

  // Half a step is at most pi / 32 wide, where these polynomials are exact to float
  // precision.
  const float half = sign * 0.5f * integral_ / K, square = h2 * half * half;
  const Turn half_step{1 - square * (0.5f - square * (1.0f / 24 - square * (1.0f / 720))),
                       half * (1 - square * (1.0f / 6 - square * (1.0f / 120)))};
  const Turn step = half_step.then(half_step, h2);
  Turn first{1, 0};
  if (!segment_.is_forward()) {
    const float s1 = segment_.s(segment_.length()), scale = 1 / (r0 * segment_.r(s1));
    first = {(h2 + s0 * s1) * scale, segment_.length() * scale};
  }
  float cosine[lanes], sine[lanes];
  Turn turn = step;
  first = first.then(half_step, h2);
  cosine[0] = first.cosine;
  sine[0] = first.sine;
  for (int width = 1; width < lanes; width *= 2, turn = turn.then(turn, h2)) {
    for (int i = 0; i < width; ++i) {
      const Turn next = Turn{cosine[i], sine[i]}.then(turn, h2);
      cosine[width + i] = next.cosine;
      sine[width + i] = next.sine;
    }
  }

  DistanceTaps<K> taps;
  std::array<float, K>& c = taps.cos_alpha;
  std::array<float, K>& s = taps.t;
  std::copy(cosine, cosine + lanes, c.begin());
  std::copy(sine, sine + lanes, s.begin());
  const float cos_turn = turn.cosine, sin_turn = turn.sine, sin_turn_h2 = h2 * turn.sine;
  for (int k = 0; k + lanes < K; ++k) {
    c[k + lanes] = c[k] * cos_turn - s[k] * sin_turn_h2;
    s[k + lanes] = s[k] * cos_turn + c[k] * sin_turn;
  }
  const float t_near = segment_.t_near(), sign_r0 = sign * r0;
  const float c_scale = -sign * s0 / r0, s_scale = -sign * h2 / r0;
  for (int k = 0; k < K; ++k) {
    const float r = r0 / (c[k] - s0 * s[k]), cos_alpha = c_scale * c[k] + s_scale * s[k];
    taps.distance[k] = r;
    taps.t[k] = t_near + sign_r0 * s[k] * r;
    taps.cos_alpha[k] = cos_alpha;
  }
  return taps;
}

}  // namespace tyndall
