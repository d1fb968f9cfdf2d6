// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/techniques/pivot_segment.h"
#include "tyndall/techniques/samples.h"

namespace tyndall {

/// Draws distances with density proportional to max(0, n . w) / D^2, w the unit direction
/// from `pivot` to the point and D its distance: single scattering of light from a point
/// with normal `n` on a diffuse, one-sided area light [Villeneuve21]. For a two-sided light
/// use the side that is drawn first.
///
/// In the equi-angular angle theta the density is the cosine of its distance from the
/// normal's projection, so that its integral is a sine. A value, built once per ray and
/// pivot; `ray.d` and `n` are unit length, t_max may be infinite.
class PointNormalSampling {
 public:
  PointNormalSampling(const Ray& ray, Vec3 pivot, Vec3 n, float t_min, float t_max)
      : PointNormalSampling(lit_stretch(ray, pivot, n, t_min, t_max)) {}

  /// Empty if the light shines on no part of the stretch, or if the stretch runs along a
  /// line through the pivot. t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    if (!(width_ > 0)) return std::nullopt;
    const float v = segment_.from_near(u);
    const float sine = std::clamp(sine_near_ + v * width_, -1.0f, 1.0f);
    // 1 - sine^2, but by its change: at grazing angles it is small at either end.
    const float cosine = safe_sqrt(sqr(cosine_near_) - v * width_ * (sine + sine_near_));
    // The sine and cosine of the way from the near end; the difference of two products is
    // expanded where it would cancel.
    const float product = sine * cosine_near_, other = cosine * sine_near_;
    const float turn = product * other > 0
                           ? v * width_ * (sine + sine_near_) / (product + other)
                           : product - other;
    const float cos_turn = sine * sine_near_ + cosine * cosine_near_;
    const float cos_end = segment_.h() * cos_turn - segment_.s_near() * turn;
    const float r = segment_.r_near();
    const float t =
        segment_.t(cos_end > 0 ? std::min(r * turn * (r / cos_end), segment_.length())
                               : segment_.length());
    const float pdf = pdf_t(t);
    if (!(pdf > 0)) return std::nullopt;
    return DistanceSample{.t = t, .pdf_t = pdf};
  }

  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const {
    if (!(width_ > 0) || !segment_.contains(t)) return 0;
    const float s = segment_.s(segment_.offset(t)), r = segment_.r(s);
    const float cosine = (normal_h_ * segment_.h() + normal_s_ * s) / r;
    return density_or_zero(std::max(cosine, 0.0f) * segment_.h() / (width_ * r * r));
  }

  /// The u that sample() maps to t, in [0, 1]; zero if the technique is empty.
  float invert(float t) const {
    if (!(width_ > 0)) return 0;
    const float offset = std::clamp(segment_.offset(t), 0.0f, segment_.length());
    return segment_.from_near(std::clamp(sine_way(offset) / width_, 0.0f, 1.0f));
  }

 private:
  /// The part of the stretch in front of the light.
  struct LitStretch {
    Ray ray;
    Vec3 pivot, n;
    float t_min, t_max;
  };

  static LitStretch lit_stretch(const Ray& ray, Vec3 pivot, Vec3 n, float t_min,
                                float t_max) {
    LitStretch lit{ray, pivot, n, t_min, t_max};
    const float slope = dot(n, ray.d), height = dot(n, ray.o - pivot);
    if (slope > 0) lit.t_min = std::max(t_min, -height / slope);
    if (slope < 0) lit.t_max = std::min(t_max, -height / slope);
    if (slope == 0 && !(height > 0)) lit.t_max = t_min;
    return lit;
  }

  explicit PointNormalSampling(const LitStretch& lit)
      : segment_(lit.ray, lit.pivot, lit.t_min, lit.t_max) {
    if (!segment_.is_proper() || !(segment_.h() > 0)) return;
    // The normal's part in the plane of ray and pivot: towards the foot, and along s.
    const float along = dot(lit.n, lit.ray.d);
    const float s_sign = segment_.sign();
    // In double: the foot's height above the light is a small difference for a far ray.
    const auto dot64 = [](Vec3 a, double x, double y, double z) {
      return a.x * x + a.y * y + a.z * z;
    };
    const Vec3 o = lit.ray.o, d = lit.ray.d, p = lit.pivot;
    const double x = double(p.x) - o.x, y = double(p.y) - o.y, z = double(p.z) - o.z;
    const double foot_height =
        dot64(lit.n, d.x, d.y, d.z) * dot64(d, x, y, z) - dot64(lit.n, x, y, z);
    const auto across = static_cast<float>(foot_height / segment_.h());
    const float in_plane = std::sqrt(across * across + along * along);
    if (!(in_plane > 0 && in_plane < infinity)) return;
    normal_h_ = across / in_plane;
    normal_s_ = s_sign * along / in_plane;
    const float cos_near = segment_.h() / segment_.r_near();
    const float sin_near = segment_.s_near() / segment_.r_near();
    sine_near_ = std::clamp(normal_h_ * sin_near - normal_s_ * cos_near, -1.0f, 1.0f);
    // A little below zero where rounding has put the edge of the light behind it.
    cosine_near_ = normal_h_ * cos_near + normal_s_ * sin_near;
    width_ = density_or_zero(sine_way(segment_.length()));
  }

  /// The sine of the angle from the normal at an offset minus that at the near end: by the
  /// chord between the two directions, which does not cancel.
  float sine_way(float offset) const {
    const bool is_finite = offset < infinity;
    const float s = segment_.s(offset), r = segment_.r(s), h = segment_.h();
    const float cos_end = is_finite ? h / r : 0, sin_end = is_finite ? s / r : 1;
    const float r0 = segment_.r_near(), cos_near = h / r0,
                sin_near = segment_.s_near() / r0;
    if (!(cos_near * cos_end + sin_near * sin_end >
          0))  // a wide angle, where nothing cancels
      return normal_h_ * sin_end - normal_s_ * cos_end - sine_near_;
    const float sum = normal_h_ * (cos_near + cos_end) + normal_s_ * (sin_near + sin_end);
    // tan(turn / 2) = sin(turn) / (1 + cos(turn))
    const float sine = is_finite ? h / r0 * (offset / r) : cos_near;
    const float cosine = cos_near * cos_end + sin_near * sin_end;
    return sum * sine / (1 + cosine);
  }

  PivotSegment segment_;
  float normal_h_ = 0, normal_s_ = 0;      // of unit length
  float sine_near_ = 0, cosine_near_ = 0;  // of the near end's angle from the normal
  float width_ = 0;                        // of the sine over the stretch
};

}  // namespace tyndall
