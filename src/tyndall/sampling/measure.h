// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tyndall {

/// Density w.r.t. solid angle [1/sr] of a point drawn by `pdf_area` [1/length^2] on a
/// surface at squared distance `distance2` that meets the connecting line at cosine
/// `abs_cos`. Infinite where the surface is seen edge-on.
constexpr float solid_angle_from_area(float pdf_area, float distance2, float abs_cos) {
  return pdf_area * distance2 / abs_cos;
}

/// The inverse of solid_angle_from_area().
constexpr float area_from_solid_angle(float pdf, float distance2, float abs_cos) {
  return pdf * abs_cos / distance2;
}

}  // namespace tyndall
