// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "tyndall/techniques/equiangular.h"
#include "tyndall/techniques/scattering_tables.h"

namespace tyndall {

/// Draws distances with density proportional to rho(cos alpha) / D^2, D the distance to the
/// pivot and alpha its angle from the ray: single scattering with its phase function, exact to
/// the tables' few 1e-6. In the angle alpha the density is rho alone.
///
/// A value, built once per ray and pivot; `ray.d` is unit length, t_max may be infinite.
/// `tables` must outlive it and be anisotropic. Empty also if the pivot lies on the line of the
/// ray, where alpha does not change: SingleScatteringDistance takes care of it.
class AnisotropicSampling {
 public:
  AnisotropicSampling(const ScatteringTables& tables, const PivotSegment& segment)
      : segment_(segment),
        k_(segment.is_forward() ? tables.k() : 1 / tables.k()),
        tangent_near_(inverse_tangent(segment.s_near(), segment.r_near())),
        arc_(tables.arc().cursor(segment.is_forward() ? k_ / (k_ + tangent_near_)
                                                      : tangent_near_ / (k_ + tangent_near_),
                                 !segment.is_forward())) {
    if (segment.is_proper() && tangent_near_ < infinity)
      integral_ = density_or_zero(arc_.integral(way(segment.length())));
  }

  bool is_empty() const { return !(integral_ > 0); }

  /// t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    if (is_empty()) return std::nullopt;
    const float way = arc_.invert(segment_.from_near(u) * integral_);
    // With c = 1 / tan(alpha / 2) as coordinate: the ratio of r + s to that of the near end.
    const float sum = k_ + tangent_near_;
    const float rest = tangent_near_ / sum - way;
    const float ratio = way * sum / (k_ * rest);
    const float t = segment_.t(rest > 0 ? segment_.offset_of_ratio(ratio) : segment_.length());
    const float pdf = pdf_t(t);
    if (!(pdf > 0)) return std::nullopt;
    return DistanceSample{.t = t, .pdf_t = pdf};
  }

  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const {
    if (is_empty() || !segment_.contains(t)) return 0;
    const float offset = segment_.offset(t);
    const float s = segment_.s(offset), r = segment_.r(s), c = inverse_tangent(s, r);
    const float slope = k_ / (k_ + c) * (c / (k_ + c)) / r;  // dy / dt
    return density_or_zero(arc_.value(way(offset)) * slope / integral_);
  }

  /// The u that sample() maps to t, in [0, 1]; zero if the technique is empty.
  float invert(float t) const {
    if (is_empty()) return 0;
    const float offset = std::clamp(segment_.offset(t), 0.0f, segment_.length());
    return segment_.from_near(std::min(arc_.integral(way(offset)) / integral_, 1.0f));
  }

 private:
  /// 1 / tan(alpha / 2), alpha counted in the direction of s.
  float inverse_tangent(float s, float r) const {
    return s > 0 ? segment_.h() / (r + s) : (r - s) / segment_.h();
  }

  /// y(alpha) at an offset minus y at the near end; no difference is taken.
  float way(float offset) const {
    const float c0 = tangent_near_;
    if (!(offset < infinity)) return c0 / (k_ + c0);
    const float s = segment_.s(offset), r = segment_.r(s), c = inverse_tangent(s, r);
    return k_ * offset * ((c + c0) / (k_ + c)) / ((r + segment_.r_near()) * (k_ + c0));
  }

  PivotSegment segment_;
  float k_;             // of the angle counted in the direction of s
  float tangent_near_;  // 1 / tan(alpha / 2) at the near end
  LinearTable::Cursor arc_;
  float integral_ = 0;
};

/// The distance of the only scattering vertex, or of the last of several: AnisotropicSampling,
/// or EquiangularSampling in isotropic media and for a pivot on the line of the ray.
class SingleScatteringDistance {
 public:
  SingleScatteringDistance(const ScatteringTables& tables, const Ray& ray, Vec3 pivot,
                           float t_min, float t_max)
      : SingleScatteringDistance(tables, PivotSegment(ray, pivot, t_min, t_max)) {}
  SingleScatteringDistance(const ScatteringTables& tables, const PivotSegment& segment)
      : technique_(choose(tables, segment)) {}

  /// Empty if the stretch is empty or runs through the pivot. t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    return std::visit([&](const auto& technique) { return technique.sample(u); }, technique_);
  }
  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const {
    return std::visit([&](const auto& technique) { return technique.pdf_t(t); }, technique_);
  }
  /// The u that sample() maps to t, in [0, 1]; zero if the technique is empty.
  float invert(float t) const {
    return std::visit([&](const auto& technique) { return technique.invert(t); }, technique_);
  }

 private:
  using Technique = std::variant<EquiangularSampling, AnisotropicSampling>;

  static Technique choose(const ScatteringTables& tables, const PivotSegment& segment) {
    if (!tables.is_isotropic()) {
      const AnisotropicSampling anisotropic(tables, segment);
      if (!anisotropic.is_empty()) return anisotropic;
    }
    return EquiangularSampling(segment);
  }

  Technique technique_;
};

}  // namespace tyndall
