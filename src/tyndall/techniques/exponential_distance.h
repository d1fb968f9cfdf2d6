// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tyndall/techniques/samples.h"

namespace tyndall {

/// Draws distances in [t_min, t_max] with density proportional to exp(-sigma_t t):
/// transmittance of a homogeneous medium, for lights so far away that nothing else changes
/// along the ray. With sigma_t = 0 they are uniform. t_max may be infinite if sigma_t is
/// positive.
class ExponentialDistance {
 public:
  ExponentialDistance(float sigma_t, float t_min, float t_max)
      : sigma_t_(sigma_t), t_min_(t_min), t_max_(t_max) {
    if (!(t_max > t_min && t_min > -infinity && sigma_t >= 0 && sigma_t < infinity)) return;
    // The integral of exp(-sigma_t (t - t_min)), in a form that holds for sigma_t = 0 as
    // well.
    const float depth = sigma_t * (t_max - t_min);
    integral_ = density_or_zero(depth > 0 ? -std::expm1(-depth) / sigma_t : t_max - t_min);
  }

  /// Empty if the stretch is. t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    if (!(integral_ > 0)) return std::nullopt;
    const float part = u * integral_, absorbed = sigma_t_ * part;
    const float way = absorbed > 0 ? -std::log1p(-absorbed) / sigma_t_ : part;
    const float t = std::min(std::clamp(t_min_ + way, t_min_, t_max_),
                             std::numeric_limits<float>::max());
    const float pdf = pdf_t(t);
    if (!(pdf > 0)) return std::nullopt;
    return DistanceSample{.t = t, .pdf_t = pdf};
  }

  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const {
    if (!(integral_ > 0 && t >= t_min_ && t <= t_max_)) return 0;
    return density_or_zero(std::exp(-sigma_t_ * (t - t_min_)) / integral_);
  }

  /// The u that sample() maps to t, in [0, 1]; zero if the technique is empty.
  float invert(float t) const {
    if (!(integral_ > 0)) return 0;
    const float way = std::clamp(t, t_min_, t_max_) - t_min_, depth = sigma_t_ * way;
    const float part = depth > 0 ? -std::expm1(-depth) / sigma_t_ : way;
    return std::min(part / integral_, 1.0f);
  }

 private:
  float sigma_t_, t_min_, t_max_;
  float integral_ = 0;
};

}  // namespace tyndall
