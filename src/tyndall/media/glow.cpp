// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/glow.h"

#include <algorithm>
#include <cmath>

#include "tyndall/media/ratio_tracking.h"
#include "tyndall/media/tracking.h"

namespace tyndall {
namespace {

// Tentative collisions on a ray, on average, where the medium itself would cause fewer:
// thin flames are looked at as often as thick ones.
constexpr float least_collisions = 6;

Rgb estimate(const HomogeneousMedium& medium, const Ray& ray, float t_max,
             RandomStream& /*rng*/, Rgb& transmittance) {
  const MediumProperties& at = medium.at(ray.o);
  const Rgb depth = optical_depth(at.sigma_t(), t_max);
  const Rgb absorbed{-std::expm1(-depth.r), -std::expm1(-depth.g), -std::expm1(-depth.b)};
  const Rgb L = transmittance * safe_divide(at.sigma_a * at.Le, at.sigma_t()) * absorbed;
  transmittance *= exp(-1 * depth);
  return L;
}

// By how much to raise the majorants along the ray.
template <typename M>
float oversampling(const M& medium, const Ray& ray, float t_max) {
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float depth = 0;
  while (depth < least_collisions && segments.next(s))
    depth += max_component(s.majorant) * (s.t_max - s.t_min);
  return depth > 0 ? std::max(least_collisions / depth, 1.0f) : 1;
}

// Ratio tracking that adds up the emission at its tentative collisions.
template <typename M>
Rgb estimate(const M& medium, const Ray& ray, float t_max, RandomStream& rng,
             Rgb& transmittance) {
  const float raise = oversampling(medium, ray, t_max);
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng);
  Rgb sum;
  while (segments.next(s)) {
    float t = s.t_min;
    while (true) {
      const float majorant = raise * largest_alive(s.majorant, transmittance);
      const float depth = majorant * (s.t_max - t);
      if (!(remaining < depth)) {
        remaining -= depth;
        break;
      }
      t = std::min(t + remaining / majorant, s.t_max);
      const MediumProperties at = segments.at(t);
      sum += transmittance * at.sigma_a * at.Le / majorant;
      transmittance *= clamp_negative(Rgb(1) - at.sigma_t() / majorant);
      transmittance = play_roulette(transmittance, rng);
      if (is_black(transmittance)) return sum;
      remaining = sample_optical_depth(rng);
    }
  }
  return sum;
}

}  // namespace

Rgb estimate_glow(const Medium& medium, const Ray& ray, float t_max, RandomStream& rng,
                  Rgb& transmittance) {
  return medium.visit(
      [&](const auto& m) { return estimate(m, ray, t_max, rng, transmittance); });
}

}  // namespace tyndall
