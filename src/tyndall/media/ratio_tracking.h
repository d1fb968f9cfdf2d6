// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

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

/// What residual ratio tracking accounts for exactly in a segment: the mean extinction
/// where what exceeds it is thin, else nothing. In deep and uneven segments rays through
/// the thin parts would get long products of factors above one, which vary more than plain
/// ratio tracking does.
inline float control_extinction(float majorant, float mean, float length) {
  constexpr float largest_excess = 0.3f;
  return (majorant - mean) * length < largest_excess ? mean : 0;
}

/// Either kind of ratio tracking in a grey medium, for less, as one channel stands for all;
/// control_of(majorant, mean, length) is what a segment accounts for exactly, zero for
/// plain ratio tracking. What the controls let through is gathered as an optical depth;
/// where it is deep, chance ends the walk.
template <typename M, typename Control>
float grey_ratio_tracking(const M& medium, const Ray& ray, float t_max, RandomStream& rng,
                          const Control& control_of) {
  constexpr float survival = 0.25f, between_roulettes = 1.3862944f;  // -log(survival)
  float roulette_depth = 2;
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng), product = 1, depth = 0;
  while (segments.next(s)) {
    const float majorant = s.majorant.r;
    if (!(majorant > 0)) continue;
    const float control = control_of(majorant, s.mean.r, s.t_max - s.t_min);
    if (control > 0) depth += control * (s.t_max - s.t_min);
    for (; depth > roulette_depth; roulette_depth += between_roulettes) {
      if (!(rng.next_1d() < survival)) return 0;
      product *= 1 / survival;
    }
    const float residual = std::max(majorant - control, control);
    SegmentPosition position(s);
    while (true) {
      const float left = residual * position.rest();
      if (remaining >= left) {
        remaining -= left;
        break;
      }
      position.advance(remaining / residual);
      product *=
          std::max(1 - (segments.sigma_t(position.t()).r - control) / residual, 0.0f);
      if (control == 0) product = play_roulette(Rgb(product), rng).r;
      if (product == 0) return 0;
      remaining = sample_optical_depth(rng);
    }
  }
  return product * std::exp(-depth);
}

/// Unbiased transmittance up to t_max, in [0, 1]: the product of the null probabilities at
/// tentative collisions [NSJ14]. The largest majorant of a channel that still counts drives
/// the walk.
template <typename M>
Rgb ratio_tracking(const M& medium, const Ray& ray, float t_max, RandomStream& rng) {
  if (medium.is_grey()) {
    const auto none = [](float, float, float) { return 0.0f; };
    return Rgb(grey_ratio_tracking(medium, ray, t_max, rng, none));
  }
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng);
  Rgb product(1);
  while (segments.next(s)) {
    SegmentPosition position(s);
    while (true) {
      const float majorant = largest_alive(s.majorant, product);
      const float depth = majorant * position.rest();
      if (remaining >= depth) {
        remaining -= depth;
        break;
      }
      position.advance(remaining / majorant);
      // Dead channels may be above the majorant, live ones only by a rounding error.
      product *= clamp_negative(Rgb(1) - segments.sigma_t(position.t()) / majorant);
      product = play_roulette(product, rng);
      if (is_black(product)) return product;
      remaining = sample_optical_depth(rng);
    }
  }
  return product;
}

/// Unbiased transmittance up to t_max, never negative: the control of each segment is
/// accounted for exactly, and only the deviations from it are tracked [NSJ14].
template <typename M>
Rgb residual_ratio_tracking(const M& medium, const Ray& ray, float t_max,
                            RandomStream& rng) {
  if (medium.is_grey())
    return Rgb(grey_ratio_tracking(medium, ray, t_max, rng,
                                   [](auto... s) { return control_extinction(s...); }));
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng);
  Rgb product(1);
  while (segments.next(s)) {
    const float length = s.t_max - s.t_min;
    const Rgb control{control_extinction(s.majorant.r, s.mean.r, length),
                      control_extinction(s.majorant.g, s.mean.g, length),
                      control_extinction(s.majorant.b, s.mean.b, length)};
    product *= exp(-1 * optical_depth(control, length));
    product = play_roulette(product, rng);
    if (is_black(product)) return product;
    SegmentPosition position(s);
    while (true) {
      // |sigma_t - control| is at most this, so that no factor of a live channel leaves
      // [0, 2].
      const float residual = std::max(largest_alive(s.majorant - control, product),
                                      largest_alive(control, product));
      const float depth = residual * position.rest();
      if (remaining >= depth) {
        remaining -= depth;
        break;
      }
      position.advance(remaining / residual);
      product *=
          clamp_negative(Rgb(1) - (segments.sigma_t(position.t()) - control) / residual);
      product = play_roulette(product, rng);
      if (is_black(product)) return product;
      remaining = sample_optical_depth(rng);
    }
  }
  return product;
}

}  // namespace tyndall
