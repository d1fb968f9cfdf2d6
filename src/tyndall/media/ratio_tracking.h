// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/tracking.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// Unbiased transmittance up to t_max, in [0, 1]: the product of the null probabilities at
/// tentative collisions [NSJ14]. The largest channel's majorant drives all channels.
template <typename M>
Rgb ratio_tracking(const M& medium, const Ray& ray, float t_max, RandomStream& rng) {
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng);
  Rgb product(1);
  while (segments.next(s)) {
    const float majorant = max_component(s.majorant);
    float t = s.t_min;
    while (true) {
      const float depth = majorant * (s.t_max - t);
      if (remaining >= depth) {
        remaining -= depth;
        break;
      }
      t = std::min(t + remaining / majorant, s.t_max);
      // The quotient may exceed one by a rounding error.
      product *= clamp_negative(Rgb(1) - segments.sigma_t(t) / majorant);
      if (is_black(product)) return product;
      remaining = sample_optical_depth(rng);
    }
  }
  return product;
}

/// Unbiased transmittance up to t_max, never negative: the mean of each segment is accounted
/// for exactly, and only the deviations from it are tracked [NSJ14].
template <typename M>
Rgb residual_ratio_tracking(const M& medium, const Ray& ray, float t_max, RandomStream& rng) {
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng);
  Rgb control;  // optical depth of the means
  Rgb product(1);
  while (segments.next(s)) {
    control += s.mean * (s.t_max - s.t_min);
    // |sigma_t - mean| is at most this, so that no factor leaves [0, 2].
    const Rgb above = s.majorant - s.mean;
    const float residual = std::max(max_component(above), max_component(s.mean));
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
  return product * exp(-1 * control);
}

}  // namespace tyndall
