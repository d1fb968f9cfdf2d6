// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/small_vector.hpp>
#include <optional>

#include "tyndall/media/transmittance.h"
#include "tyndall/sampling/random.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// Stands for infinity where a product with zero must stay zero [scene units].
inline constexpr float far_distance = 1e30f;

/// The straight way of light from a vertex to the first surface that is not a mere
/// boundary, cut into spans of one medium each. Traced no farther than asked for.
class Leg {
 public:
  struct Span {
    float t_min, t_max;    ///< along ray() [scene units]
    const Medium* medium;  ///< null in empty space
  };

  Leg(const Scene& scene, const Ray& ray, const Medium* medium);

  const Ray& ray() const { return ray_; }
  /// The i-th span, or null if the leg has fewer.
  const Span* span(size_t i);
  /// The surface at the end; null if the leg leaves the scene. Traces everything.
  const SurfaceHit* end();
  /// Length of the whole leg, far_distance if it leaves the scene. Traces everything.
  float length();
  /// The medium at its end.
  const Medium* end_medium();

 private:
  void trace_span();
  void cross_boundary();
  void trace_all();

  const Scene* scene_;
  Ray ray_;
  boost::container::small_vector<Span, 4> spans_;
  std::optional<SurfaceHit> end_;  // once somebody asks
  bool is_complete_ = false;
  // The last ray, what it found, and the medium that it went through:
  Ray last_;
  std::optional<FoundSurface> found_;
  float t_ = 0;
  const Medium* medium_;
};

/// Unbiased estimate of the transmittance of one medium. Never negative, as radiance must
/// not be: ray marching has the least variance, but a negative sample every few thousand
/// paths.
inline Rgb estimate_span(const Medium& medium, const Ray& ray, float t_max,
                         RandomStream& rng) {
  return estimate_transmittance(medium, ray, t_max, rng,
                                TransmittanceMethod::ratio_tracking);
}

/// Unbiased estimate of the radiance that the media along a leg emit towards its start.
Rgb glow_along(Leg& leg, RandomStream& rng);

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
