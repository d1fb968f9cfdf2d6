// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/tracking.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// Russian roulette on small transmittances, channel by channel: zero, or the larger by the
/// inverse of the probability to survive.
inline Rgb play_roulette(Rgb transmittance, RandomStream& rng) {
  constexpr float threshold = 0.05f, survival = 0.25f;
  if (min_component(transmittance) >= threshold) return transmittance;
  const float gain = rng.next_1d() < survival ? 1 / survival : 0;
  const auto play = [&](float T) { return T < threshold ? T * gain : T; };
  return {play(transmittance.r), play(transmittance.g), play(transmittance.b)};
}

/// The largest of `sigma` among the channels that have any transmittance left.
inline float largest_alive(Rgb sigma, Rgb transmittance) {
  return std::max({transmittance.r > 0 ? sigma.r : 0, transmittance.g > 0 ? sigma.g : 0,
                   transmittance.b > 0 ? sigma.b : 0});
}

/// ratio_tracking() in a grey medium: the same walk and the same estimate for less, as one
/// channel stands for all.
template <typename M>
float grey_ratio_tracking(const M& medium, const Ray& ray, float t_max, RandomStream& rng) {
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng), product = 1;
  while (segments.next(s)) {
    const float majorant = s.majorant.r;
    float t = s.t_min;
    while (true) {
      const float depth = majorant * (s.t_max - t);
      if (remaining >= depth) {
        remaining -= depth;
        break;
      }
      t = std::min(t + remaining / majorant, s.t_max);
      product *= std::max(1 - segments.sigma_t(t).r / majorant, 0.0f);
      product = play_roulette(Rgb(product), rng).r;
      if (product == 0) return 0;
      remaining = sample_optical_depth(rng);
    }
  }
  return product;
}

/// Unbiased transmittance up to t_max, in [0, 1]: the product of the null probabilities at
/// tentative collisions [NSJ14]. The largest majorant of a channel that still counts drives
/// the walk.
template <typename M>
Rgb ratio_tracking(const M& medium, const Ray& ray, float t_max, RandomStream& rng) {
  if (medium.is_grey()) return Rgb(grey_ratio_tracking(medium, ray, t_max, rng));
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng);
  Rgb product(1);
  while (segments.next(s)) {
    float t = s.t_min;
    while (true) {
      const float majorant = largest_alive(s.majorant, product);
      const float depth = majorant * (s.t_max - t);
      if (remaining >= depth) {
        remaining -= depth;
        break;
      }
      t = std::min(t + remaining / majorant, s.t_max);
      // Dead channels may be above the majorant, live ones only by a rounding error.
      product *= clamp_negative(Rgb(1) - segments.sigma_t(t) / majorant);
      product = play_roulette(product, rng);
      if (is_black(product)) return product;
      remaining = sample_optical_depth(rng);
    }
  }
  return product;
}

/// Unbiased transmittance up to t_max, never negative: the mean of each segment is
/// accounted for exactly, and only the deviations from it are tracked [NSJ14].
template <typename M>
Rgb residual_ratio_tracking(const M& medium, const Ray& ray, float t_max,
                            RandomStream& rng) {
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng);
  Rgb product(1);
  while (segments.next(s)) {
    product *= exp(-1 * optical_depth(s.mean, s.t_max - s.t_min));
    product = play_roulette(product, rng);
    if (is_black(product)) return product;
    // |sigma_t - mean| is at most this, so that no factor leaves [0, 2].
    const Rgb above = s.majorant - s.mean;
    const float residual =
        std::max(largest_alive(above, product), largest_alive(s.mean, product));
    float t = s.t_min;
    while (true) {
      const float depth = residual * (s.t_max - t);
      if (remaining >= depth) {
        remaining -= depth;
        break;
      }
      t = std::min(t + remaining / residual, s.t_max);
      product *= clamp_negative(Rgb(1) - (segments.sigma_t(t) - s.mean) / residual);
      remaining = sample_optical_depth(rng);
    }
  }
  return product;
}

}  // namespace tyndall
