// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/media/transmittance.h"
#include "tyndall/sampling/random.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// Stands for infinity where a product with zero must stay zero [scene units].
inline constexpr float far_distance = 1e30f;

/// Rays between two points stop short of the second by this share of their length, for the
/// rounding of the length itself, and by rounded_end().
inline constexpr float shadow_shortening = 1e-6f;

/// How far a ray towards a sample of a light is followed to find what hides it.
inline float shadow_length(const LightSample& sample) {
  return sample.distance * (1 - shadow_shortening) - sample.rounded_end;
}

/// The straight way of light from a vertex to the first surface that is not a mere
/// boundary, cut into spans of one medium each. Traced once somebody asks.
class Leg {
 public:
  using Span = MediumSpan;

  Leg(const Scene& scene, const Ray& ray, const Medium* medium);

  const Ray& ray() const { return ray_; }
  /// The i-th span, or null if the leg has fewer.
  const Span* span(size_t i);
  /// The surface at the end; null if the leg leaves the scene.
  const SurfaceHit* end();
  /// Follows the ray no farther than t. To be called before anything is asked of the leg.
  void limit(float t) { t_max_ = t; }
  /// Length of the whole leg, far_distance if it leaves the scene.
  float length();
  /// The medium at its end.
  const Medium* end_medium();

 private:
  void trace();

  const Scene* scene_;
  Ray ray_;
  float t_max_ = far_distance;
  MediumSpans spans_;  // empty until traced
  std::optional<FoundSurface> found_;
  std::optional<SurfaceHit> end_;  // once somebody asks
  const Medium* medium_;           // at the start, then at the end
};

/// The medium at a point, by way of the boundaries between there and the camera.
const Medium* medium_at(const Scene& scene, Vec3 p);

/// Unbiased estimate of the transmittance of one medium, never negative.
inline Rgb estimate_span(const Medium& medium, const Ray& ray, float t_max,
                         RandomStream& rng) {
  return estimate_transmittance(medium, ray, t_max, rng);
}

/// Unbiased estimate of the radiance that the media along a leg emit towards its start.
Rgb glow_along(Leg& leg, RandomStream& rng);

/// Unbiased estimate of the transmittance of the media along [0, t] of a leg.
Rgb transmittance_along(Leg& leg, float t, RandomStream& rng);

/// Light that goes along [0, t_max] of a ray that no surface blocks, through all boundaries
/// in between.
struct Passage {
  Rgb transmittance;         ///< an unbiased estimate
  const Medium* end_medium;  ///< where it arrives, unless the estimate is black
};
Passage passage(const Scene& scene, const Ray& ray, float t_max, const Medium* medium,
                RandomStream& rng);

/// The transmittance of passage().
inline Rgb transmittance(const Scene& scene, const Ray& ray, float t_max,
                         const Medium* medium, RandomStream& rng) {
  return passage(scene, ray, t_max, medium, rng).transmittance;
}

}  // namespace tyndall
