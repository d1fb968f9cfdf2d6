// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "tyndall/math/frame.h"
#include "tyndall/media/phase_function.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {

/// Where a vertex scatters light to: as a phase function does, or as a diffuse surface. One
/// lobe around an axis.
class ScatteringLobe {
 public:
  /// Of a vertex that was reached in the unit direction `w_ab`. The phase function must
  /// outlive the lobe.
  ScatteringLobe(const PhaseFunction& phase, Vec3 w_ab) : phase_(&phase), axis_(w_ab) {}
  /// Of a surface, whose unit normal on the side of the light is `n`.
  explicit ScatteringLobe(Vec3 n) : axis_(n) {}

  Vec3 axis() const { return axis_; }
  float mean_cosine() const { return phase_ ? phase_->mean_cosine() : 2.0f / 3; }
  std::optional<Vec3> sample(Vec2 u) const {
    if (!phase_) return Frame::from_z(axis_).to_world(sample_cosine_hemisphere(u));
    const auto s = phase_->sample(-axis_, u);
    if (!s) return std::nullopt;
    return s->wi;
  }
  /// Density of sample() at the unit vector w [1/sr].
  float pdf(Vec3 w) const {
    return phase_ ? phase_->pdf(-axis_, w) : std::max(dot(axis_, w), 0.0f) * inv_pi;
  }

 private:
  const PhaseFunction* phase_ = nullptr;  // null: diffuse
  Vec3 axis_;
};

}  // namespace tyndall
