// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "tyndall/integrators/particle.h"
#include "tyndall/math/add_relaxed.h"

namespace tyndall {

/// Light tracing for what walks from the camera find by chance at best: light that reaches
/// the first vertex that the camera sees, directly or scattered, by way of surfaces that
/// refract or mirror it out of a lamp ("caustics"). Particles fly out of the lights, over
/// those surfaces, and each vertex beyond is connected to the camera.
///
/// Where walks can find such a path too, by hitting the lamp, the balance heuristic weighs
/// both. Safe to use from all threads.
class ParticleTracer {
 public:
  ParticleTracer(const Scene& scene, const RenderSettings& settings,
                 const ParticleRules& rules);

  /// Whether there is anything for particles to do.
  bool is_useful() const;
  /// Particles for one sample of each pixel.
  uint32_t count() const { return count_; }
  /// How many there are from now on, as a share of count(); at least one if it is not zero.
  void change_count(double share);
  /// A walk from the camera has cost so many rays.
  void record_walk(float rays) const {
    if (is_measuring_) add_relaxed(walk_rays_, static_cast<int64_t>(rays));
  }
  void end_measuring() { is_measuring_ = false; }
  /// Rays of all walks that were recorded.
  double walk_rays() const { return static_cast<double>(walk_rays_.load()); }
  /// Density of particles at a light: ParticleSource::density() of one times their number.
  float density(size_t light, Vec3 w, Vec3 p) const {
    return static_cast<float>(count_) * source_.density(light, w, p);
  }
  /// Traces particles [first, end) of those of the sample `index` of all pixels, and writes
  /// what they find behind `splats`; it is to be divided by count(). Returns what that cost
  /// [rays].
  int64_t trace(uint32_t index, uint32_t first, uint32_t end, const SplatCanvas& canvas,
                std::vector<Splat>& splats) const;

 private:
  const Scene* scene_;
  SamplerKind sampler_;
  uint64_t seed_;
  ParticleRules rules_;
  ParticleSource source_;
  uint32_t count_;
  bool is_measuring_ = true;
  mutable std::atomic<int64_t> walk_rays_ = 0;
};

}  // namespace tyndall
