// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/math/frame.h"
#include "tyndall/techniques/samples.h"
#include "tyndall/techniques/scattering_tables.h"

namespace tyndall {

/// Draws the direction from the first of two scattering vertices, at `b`, to the second,
/// with density proportional to the light of a point source at `pivot` that is scattered
/// somewhere along that direction towards b, and by b along the given ray, without
/// transmittance and visibility [Georgiev13]: rho(w_ab . w) P(theta) / sin(theta), theta
/// the angle from the pivot. The density is infinite towards the pivot, as the light is.
///
/// A value, built once per vertex and pivot; `tables` must outlive it.
class DoubleScatteringDirection {
 public:
  /// `w_ab` is the unit direction in which the ray reached b; rho peaks there if g > 0.
  DoubleScatteringDirection(const ScatteringTables& tables, Vec3 b, Vec3 w_ab, Vec3 pivot);
  /// Without the phase function at b, for first vertices that are not in a medium or
  /// scatter otherwise: P(theta) / sin(theta) only.
  DoubleScatteringDirection(const ScatteringTables& tables, Vec3 b, Vec3 pivot);

  /// Empty if b is the pivot, or in the direction of infinite density.
  std::optional<DoubleDirectionSample> sample(Vec2 u) const;
  /// Density of sample() at the unit vector w [1/sr]; zero where it is not finite.
  float pdf(Vec3 w) const;
  /// The u that sample() maps to w, in [0, 1]^2; zero if the technique is empty.
  Vec2 invert(Vec3 w) const;

 private:
  struct Polar;
  struct TablePoint;

  void look_at(Vec3 b, Vec3 pivot);
  std::optional<DoubleDirectionSample> sample_isotropic(Vec2 u) const;
  std::optional<DoubleDirectionSample> sample_tables(Vec2 u) const;
  float isotropic_pdf(Vec3 w, float angle_from_behind) const;
  float sin_theta_of(Vec3 w) const;
  Polar polar(Vec3 w) const;
  TablePoint table_point(const Polar& polar) const;
  LinearRows::Blend polar_density() const;
  LinearRows::Blend azimuth(float e) const;
  float azimuth_ratio(float sin_half, float cos_half) const;
  float polar_slope(const Polar& polar) const;
  float azimuth_slope(const Polar& polar, float e) const;

  const ScatteringTables* tables_;
  double x_ = 0, y_ = 0, z_ = 1;       // unit vector to the pivot
  Frame frame_{};                      // z to the pivot, x in the half-plane of w_ab
  float sin_half_ = 0, cos_half_ = 1;  // of alpha, the angle between w_ab and z
  float y_alpha_ = 0;
  int row_ = 0;           // of alpha, rounded down
  float row_weight_ = 0;  // of the next row
  bool is_any_direction_ = false;
  bool is_proper_ = false;
};

}  // namespace tyndall
