// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall {

inline constexpr double full_turn = 2 * std::numbers::pi;  ///< [rad]

/// The azimuth of the point (x, y) in [0, 2 pi).
inline double azimuth(double x, double y) {
  const double phi = std::atan2(y, x);
  return phi < 0 ? phi + full_turn : phi;
}

/// The range of azimuths that a shape's `phi_max` [rad] stands for: at most a full turn,
/// and exactly that where only the rounding of 360 degrees is missing.
inline double azimuth_range(float phi_max) {
  const double phi = std::max(static_cast<double>(phi_max), 0.0);
  return phi > full_turn * (1 - 1e-6) ? full_turn : phi;
}

}  // namespace tyndall
