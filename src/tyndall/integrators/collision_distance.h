// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/integrators/leg_proxy.h"
#include "tyndall/techniques/distance_taps.h"

namespace tyndall {

/// Draws distances as a walk collides along the proxy of a leg, but for certain: for lights
/// so far away that nothing else of what the leg knows changes along it.
///
/// A value; the proxy must outlive it.
class CollisionDistance {
 public:
  explicit CollisionDistance(const LegProxy& proxy)
      : proxy_(&proxy), share_(proxy.collision_share()) {}

  /// Empty where nothing scatters. t grows with u.
  std::optional<DistanceSample> sample(float u) const { return proxy_->sample(u); }
  /// Density of sample() at t [1/scene unit].
  float pdf_t(float t) const {
    return share_ > 0 ? density_or_zero(proxy_->collision_pdf_t(t) / share_) : 0;
  }
  /// The u that sample() maps to t, in [0, 1].
  float invert(float t) const {
    return share_ > 0 ? std::min((1 - proxy_->transmittance(t)) / share_, 1.0f) : 0;
  }
  /// The distances at about u = (i + 1/2) / K. Precondition: something scatters.
  template <int K>
  std::array<float, K> taps() const {
    std::array<float, K> u;
    for (int i = 0; i < K; ++i) u[i] = (static_cast<float>(i) + 0.5f) / K;
    proxy_->sample_roughly(u);
    return u;
  }

 private:
  const LegProxy* proxy_;
  float share_;
};

}  // namespace tyndall
