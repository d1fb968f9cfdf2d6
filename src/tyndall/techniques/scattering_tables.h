// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tyndall/techniques/linear_rows.h"
#include "tyndall/techniques/linear_table.h"

namespace tyndall {

/// What the joint sampling of single and double scattering knows about a phase function:
/// tables for the Henyey-Greenstein phase function of one asymmetry, shared by all rays.
/// Immutable; build one per medium (a few ten milliseconds; about 58 k floats). Techniques
/// keep a pointer to it. At g = 0 there are no tables, and the techniques use closed forms
/// [Georgiev13].
///
/// Angles are kept as y = k v / (1 + k v) in [0, 1], v the tangent of half the angle and
/// k = sqrt((1 + |g|) / (1 - |g|)) or its inverse for backward scattering: in y the peak of
/// the phase function is as wide at every g as a table can hold, and no trigonometry is
/// needed.
class ScatteringTables {
 public:
  /// Precondition: -1 < g < 1.
  explicit ScatteringTables(float g);

  float g() const { return g_; }
  bool is_isotropic() const { return g_ == 0; }
  float k() const { return k_; }  ///< of arc(): sqrt((1 + g) / (1 - g))
  float inverse_k() const { return inverse_k_; }
  /// Of theta(): less than k(), to resolve the neighbourhood of pi as well, where the light
  /// scattered once along a direction vanishes; one if g < 0.
  float k_theta() const { return k_theta_; }

  /// The phase function over angles, in y: the integral of rho(cos a) da.
  const LinearTable& arc() const { return arc_; }
  /// F(alpha), the twice scattered light from distance one at angle alpha, over
  /// log(tan(alpha / 2)); up to a factor.
  const LinearTable& fluence() const { return fluence_; }
  /// The polar angle theta of double scattering, given alpha: row i for the i-th of
  /// equidistant y(alpha), its pieces below and above theta = alpha; see ThetaWarp. Each
  /// row has mass one.
  const LinearRows& theta() const { return theta_; }
  /// The polar angle if light arrives at the first vertex from everywhere alike: one row
  /// and piece, that above alpha = 0. Mass one.
  const LinearRows& theta_of_any_direction() const { return theta_of_any_direction_; }
  /// The azimuth phi of double scattering, the same for all phase functions: the density
  /// (1 - k cos phi)^(-3/2), k = (1 - e^2) / (1 + e^2), over
  /// eta = tan(phi/2) / (e + tan(phi/2)). Row i is e = (i / (rows - 1))^2. Each has mass
  /// one.
  const LinearRows& azimuth() const { return *azimuth_; }

  /// Number of floats held, the shared azimuth() left out; a double counts as two.
  size_t size() const {
    return arc_.size() + fluence_.size() + theta_.size() + theta_of_any_direction_.size();
  }

  static constexpr int alpha_rows = 96;   ///< values of alpha in theta()
  static constexpr int theta_cells = 64;  ///< per piece of theta()
  static constexpr int azimuth_rows = 33, azimuth_cells = 64;  ///< of azimuth()

 private:
  float g_, k_, inverse_k_, k_theta_;
  LinearTable arc_, fluence_;
  LinearRows theta_, theta_of_any_direction_;
  const LinearRows* azimuth_;  // shared by all
};

/// Where a piece of a theta row has its nodes: z in [0, 1] from theta = alpha (z = 0)
/// outwards, fine where the phase function of the first vertex has its peak. `a` is
/// y(alpha).
struct ThetaWarp {
  float a;
  float side;   ///< 1 if theta > alpha, else -1
  float width;  ///< of the piece in y

  ThetaWarp(float y_alpha, float sign)
      : a(y_alpha), side(sign), width(by_sign(sign, 1 - y_alpha, y_alpha)) {}

  static constexpr float linear_part = 0.05f;

  /// y(theta) at z.
  float y(float z) const {
    return a + side * width * (z * (linear_part + (1 - linear_part) * z));
  }
  /// z at y(theta), for a positive width.
  float z(float y) const;
  /// |dy / dz|
  float slope(float z) const { return width * (linear_part + 2 * (1 - linear_part) * z); }
};

}  // namespace tyndall
