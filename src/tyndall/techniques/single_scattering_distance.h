// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/techniques/equiangular.h"
#include "tyndall/techniques/scattering_tables.h"

namespace tyndall {

/// Draws distances with density proportional to rho(cos alpha) / D^2, D the distance to the
/// pivot and alpha its angle from the ray: the only scattering vertex between a ray and a
/// light, or the last of several, exact to the tables' few 1e-6. In the angle alpha the
/// density is rho alone. In isotropic media, and for a pivot on the line of the ray, where
/// alpha does not change, it is EquiangularSampling.
///
/// A value, built once per ray and pivot; `ray.d` is unit length, t_max may be infinite.
/// `tables` must outlive it.
class SingleScatteringDistance {
 public:
  SingleScatteringDistance(const ScatteringTables& tables, const Ray& ray, Vec3 pivot,
                           float t_min, float t_max)
      : SingleScatteringDistance(tables, PivotSegment(ray, pivot, t_min, t_max)) {}
  SingleScatteringDistance(const ScatteringTables& tables, const PivotSegment& segment)
      : segment_(segment) {
    if (!segment_.is_proper()) return;
    if (!tables.is_isotropic()) tabulate(tables);
    if (!is_tabulated_)
      integral_ = density_or_zero(inverse_square_integral(segment_, segment_.length()));
  }

  /// Empty if the stretch is empty or runs through the pivot. t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    if (!(integral_ > 0)) return std::nullopt;
    const float part = segment_.from_near(u) * integral_;
    const float offset =
        is_tabulated_ ? arc_offset(part) : inverse_square_offset(segment_, part);
    const float t = segment_.t(offset);
    const float pdf = pdf_t(t);
    if (!(pdf > 0)) return std::nullopt;
    return DistanceSample{.t = t, .pdf_t = pdf};
  }

  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const {
    if (!(integral_ > 0) || !segment_.contains(t)) return 0;
    const float offset = segment_.offset(t), s = segment_.s(offset);
    if (!is_tabulated_)
      return density_or_zero(1 / (integral_ * (sqr(segment_.h()) + sqr(s))));
    const float r = segment_.r(s);
    const Angle angle = this->angle(s, r);
    const float slope = k_ * angle.tangent * angle.rest;  // r dy / dt
    return density_or_zero(arc_.value(way(offset, r, angle)) * slope / (r * integral_));
  }

  /// The u that sample() maps to t, in [0, 1]; zero if the technique is empty.
  float invert(float t) const {
    if (!(integral_ > 0)) return 0;
    const float offset = std::clamp(segment_.offset(t), 0.0f, segment_.length());
    const float part = is_tabulated_ ? arc_.integral(way(offset))
                                     : inverse_square_integral(segment_, offset);
    return segment_.from_near(std::min(part / integral_, 1.0f));
  }

 private:
  /// y(alpha) = k tangent and 1 - y = rest, alpha counted in the direction of s.
  struct Angle {
    float tangent, rest;
  };

  void tabulate(const ScatteringTables& tables) {
    const float sign = segment_.sign();
    k_ = by_sign(sign, tables.k(), tables.inverse_k());
    near_ = angle(segment_.s_near(), segment_.r_near());
    arc_ = tables.arc().cursor(by_sign(sign, k_ * near_.tangent, near_.rest), sign);
    integral_ = density_or_zero(arc_.integral(way(segment_.length())));
    is_tabulated_ = integral_ > 0 && near_.tangent > 0;
    if (!is_tabulated_) integral_ = 0;
  }

  /// From tan(alpha / 2) = h / (r - s).
  Angle angle(float s, float r) const {
    const float h = segment_.h(), sum = r + magnitude(s);
    const float tangent = by_sign(s, sum, h), rest = by_sign(s, h, sum);
    const float scale = 1 / (k_ * tangent + rest);
    return {tangent * scale, rest * scale};
  }

  /// y(alpha) at an offset minus y at the near end; no difference is taken.
  float way(float offset) const {
    if (!(offset < infinity)) return near_.rest;
    const float s = segment_.s(offset), r = segment_.r(s);
    return way(offset, r, angle(s, r));
  }
  float way(float offset, float r, const Angle& angle) const {
    return k_ * (offset / (r + segment_.r_near())) *
           (angle.rest * near_.tangent + near_.rest * angle.tangent);
  }

  /// The offset up to which the integral of the phase function over alpha is `part`.
  float arc_offset(float part) const {
    const float way = arc_.invert(part), rest = near_.rest - way;
    if (!(rest > 0)) return segment_.length();
    // s = ((r + s) - (r - s)) / 2, where r + s grows by the factor 1 + way / stayed.
    const float stayed = k_ * near_.tangent * rest;
    const float s = segment_.s_near(), r = segment_.r_near();
    return 0.5f * way *
           (segment_.plus(s, r) / stayed + segment_.minus(s, r) / (stayed + way));
  }

  PivotSegment segment_;
  LinearTable::Cursor arc_;
  float k_ = 1;  // of the angle counted in the direction of s
  Angle near_{};
  float integral_ = 0;
  bool is_tabulated_ = false;
};

}  // namespace tyndall
