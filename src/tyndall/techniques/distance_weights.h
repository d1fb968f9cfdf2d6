// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "tyndall/techniques/distance_taps.h"
#include "tyndall/techniques/fast_exp.h"

namespace tyndall {

/// Multiplies each weight by half of its own factor and a quarter of each neighbour's, lest
/// one that an edge cuts is taken for dark. The factor of weights[i] is factors[i + 1]; the
/// places before the first and behind the last are filled here.
[[gnu::always_inline]] inline void multiply_mixed(std::span<float> factors,
                                                  std::span<float> weights) {
  const size_t n = weights.size();
  factors[0] = factors[1];
  factors[n + 1] = factors[n];
  for (size_t i = 0; i < n; ++i)
    weights[i] *= 0.25f * (factors[i] + factors[i + 2]) + 0.5f * factors[i + 1];
}

/// What a distance technique leaves out of an integrand, at its taps: the argument of
/// BinnedDistance. Any further factor, such as predicted visibility, is multiplied in by
/// hand.
template <int K>
struct DistanceWeights {
  alignas(32) std::array<float, K> values;

  static DistanceWeights ones() {
    DistanceWeights weights;
    weights.values.fill(1);
    return weights;
  }

  /// Each weight for the taps of a denser set around it.
  template <int N>
  DistanceWeights<N> spread() const {
    static_assert(N % K == 0);
    DistanceWeights<N> weights;
    for (int i = 0; i < N; ++i) weights.values[i] = values[i / (N / K)];
    return weights;
  }

  /// Transmittance along the ray and from the tap to the pivot in a homogeneous medium.
  DistanceWeights& multiply_transmittance(const DistanceTaps<K>& taps, float sigma_t) {
    for (int i = 0; i < K; ++i)
      values[i] *= fast_exp(-sigma_t * (taps.t[i] + taps.distance[i]));
    return *this;
  }

  /// exp(-depth): transmittance from optical depths, one per tap.
  DistanceWeights& multiply_transmittance(const std::array<float, K>& optical_depth) {
    for (int i = 0; i < K; ++i) values[i] *= fast_exp(-optical_depth[i]);
    return *this;
  }

  /// The Henyey-Greenstein phase function of light from the pivot into the ray, up to a
  /// factor.
  DistanceWeights& multiply_phase(const DistanceTaps<K>& taps, float g) {
    if (g == 0) return *this;
    const float a = 1 + g * g, b = 2 * g, floor = (1 - std::abs(g)) * (1 - std::abs(g));
    for (int i = 0; i < K; ++i) {
      const float x = a - b * taps.cos_alpha[i];
      const float d = x > floor ? x : floor;
      values[i] /= d * std::sqrt(d);
    }
    return *this;
  }
};

}  // namespace tyndall
