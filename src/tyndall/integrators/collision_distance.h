// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "tyndall/integrators/leg_proxy.h"
#include "tyndall/techniques/distance_taps.h"

namespace tyndall {

/// Draws distances as a walk collides along the proxy of a leg, but for certain: for lights
/// so far away that nothing else of what the leg knows changes along it. Not beyond
/// `t_max`: what a proxy lets through there is no measure of what the medium does.
///
/// A value; the proxy must outlive it.
class CollisionDistance {
 public:
  CollisionDistance(const LegProxy& proxy, float t_max)
      : proxy_(&proxy), t_max_(t_max), share_(proxy.collision_share(t_max)) {}

  /// Empty where nothing scatters. t grows with u.
  std::optional<DistanceSample> sample(float u) const {
    std::optional<DistanceSample> s = proxy_->sample(u, share_);
    if (s) s->t = std::min(s->t, t_max_);
    return s;
  }
  /// Density of sample() at t [1/scene unit].
  float pdf_t(float t) const {
    if (!(share_ > 0 && t <= t_max_)) return 0;
    return density_or_zero(proxy_->collision_pdf_t(t) / share_);
  }
  /// The u that sample() maps to t, in [0, 1].
  float invert(float t) const {
    return share_ > 0 ? std::min(proxy_->collision_share(t) / share_, 1.0f) : 0;
  }
  /// The distances at about u = (i + 1/2) / K. Precondition: something scatters.
  template <int K>
  std::array<float, K> taps() const {
    std::array<float, K> u;
    for (int i = 0; i < K; ++i) u[i] = (static_cast<float>(i) + 0.5f) / K;
    proxy_->sample_roughly(u, share_);
    return u;
  }

 private:
  const LegProxy* proxy_;
  float t_max_, share_;
};

}  // namespace tyndall
