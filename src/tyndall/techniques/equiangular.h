// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/techniques/distance_taps.h"
#include "tyndall/techniques/pivot_segment.h"
#include "tyndall/techniques/samples.h"

namespace tyndall {

/// Draws distances in [t_min, t_max] with density proportional to the inverse squared distance
/// to `pivot`, usually a point on a light [KF12]: single scattering without its phase function.
///
/// A value, built once per ray and pivot; `ray.d` is unit length, t_max may be infinite. The
/// pivot may lie anywhere but on the stretch itself; there the technique is empty.
class EquiangularSampling {
 public:
  EquiangularSampling(const Ray& ray, Vec3 pivot, float t_min, float t_max)
      : EquiangularSampling(PivotSegment(ray, pivot, t_min, t_max)) {}
  explicit EquiangularSampling(const PivotSegment& segment)
      : segment_(segment),
        integral_(segment.is_proper() ? density_or_zero(inverse_square(segment.length()))
                                      : 0) {}

  /// The integral of the inverse squared distance over the stretch [1/scene unit]: what the
  /// weight of a sample is where nothing else varies. Zero if the technique is empty.
  float integral() const { return integral_; }

  /// Empty if the stretch is empty or runs through the pivot. t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    if (!(integral_ > 0)) return std::nullopt;
    const float t = segment_.t(offset(segment_.from_near(u) * integral_));
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
    return segment_.from_near(std::min(inverse_square(offset) / integral_, 1.0f));
  }

  /// The points at u = (i + 1/2) / K; t to about 1e-5 of its range.
  template <int K>
  DistanceTaps<K> taps() const;

  const PivotSegment& segment() const { return segment_; }

 private:
  /// The integral of 1 / (h^2 + s^2) from the near end to an offset: the angle under which the
  /// pivot sees the stretch, over h. As the arc tangent of a quotient of products it keeps its
  /// relative precision for small angles, and is defined for h = 0.
  float inverse_square(float offset) const {
    const double h = segment_.h(), s0 = segment_.s_near();
    const bool is_finite = offset < infinity;
    const double cosine = is_finite ? h * h + s0 * (s0 + offset) : s0;
    const double sine_over_h = is_finite ? offset : 1;
    const auto tangent = static_cast<float>(h * sine_over_h / cosine);
    const auto tangent_over_h = static_cast<float>(sine_over_h / cosine);
    if (cosine > 0)
      return tangent > 0 ? std::atan(tangent) / tangent * tangent_over_h : tangent_over_h;
    const float angle = cosine < 0 ? pi + std::atan(tangent) : 0.5f * pi;
    return angle / segment_.h();
  }

  /// The offset up to which inverse_square() is `part`: the near end's direction from the pivot
  /// turned by the angle h * part.
  float offset(float part) const {
    const float angle = segment_.h() * part;
    const float sine_over_h = angle > 0 ? std::sin(angle) / angle * part : part;
    const float cosine = std::cos(angle) - segment_.s_near() * sine_over_h;
    if (!(cosine > 0)) return segment_.length();
    const float r = segment_.r_near();
    return std::min(r * sine_over_h * (r / cosine), segment_.length());
  }

  PivotSegment segment_;
  float integral_;
};

template <int K>
DistanceTaps<K> EquiangularSampling::taps() const {
  // The unit vector from the pivot turns by equal angles from tap to tap, so that each is the
  // product of two rotations: eight of the first eight taps, and the power of one.
  constexpr int lanes = 8;
  static_assert(K % lanes == 0);
  const float h = segment_.h(), s0 = segment_.s_near(), r0 = segment_.r_near();
  const float sign = segment_.is_forward() ? 1.0f : -1.0f;
  const float step = integral_ / K;
  // Sines are kept over h, which may be zero.
  float cosine[lanes], sine[lanes];
  for (int i = 0; i < lanes; ++i) {
    const float part = (static_cast<float>(i) + 0.5f) * step;
    const float near = segment_.is_forward() ? part : integral_ - part;
    const float angle = h * near;
    cosine[i] = std::cos(angle);
    sine[i] = angle > 0 ? std::sin(angle) / angle * near : near;
  }
  const float turn = sign * h * lanes * step;
  const float cos_turn = std::cos(turn);
  const float sin_turn = turn != 0 ? std::sin(turn) / turn * sign * lanes * step
                                   : sign * lanes * step;
  const float h2 = h * h, r2 = r0 * r0, inv_r0 = 1 / r0;
  const float t_near = segment_.is_forward() ? segment_.t_min() : segment_.t_max();
  DistanceTaps<K> taps;
  for (int block = 0; block < K / lanes; ++block) {
    for (int i = 0; i < lanes; ++i) {
      const float c = cosine[i], s = sine[i];
      const float inverse = 1 / (c - s0 * s);
      const int k = block * lanes + i;
      taps.t[k] = t_near + sign * (r2 * s * inverse);
      taps.distance[k] = r0 * inverse;
      taps.cos_alpha[k] = -sign * (s0 * c + h2 * s) * inv_r0;
      cosine[i] = c * cos_turn - h2 * s * sin_turn;
      sine[i] = s * cos_turn + c * sin_turn;
    }
  }
  return taps;
}

}  // namespace tyndall
