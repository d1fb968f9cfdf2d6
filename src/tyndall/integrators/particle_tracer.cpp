// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/particle_tracer.h"

#include <algorithm>

namespace tyndall {
namespace {

// Of the numbers that particles draw: no pixel's.
constexpr int particle_column = -2;

// Of choosing where a particle starts [rays].
constexpr int start_cost = 1;

uint32_t pixel_count(const RenderSettings& settings) {
  const Vec2i size = settings.crop_max - settings.crop_min;
  return static_cast<uint32_t>(size.x) * static_cast<uint32_t>(size.y);
}

}  // namespace

ParticleTracer::ParticleTracer(const Scene& scene, const RenderSettings& settings,
                               const ParticleRules& rules)
    : scene_(&scene),
      sampler_(settings.sampler),
      seed_(settings.seed),
      rules_(rules),
      source_(scene, settings.seed),
      count_(pixel_count(settings)) {}

// A specular vertex and one that is not.
bool ParticleTracer::is_useful() const {
  return source_.is_useful() && rules_.max_depth >= 2;
}

void ParticleTracer::change_count(double share) {
  if (share > 0)
    count_ = std::max(static_cast<uint32_t>(share * count_), 1u);
  else
    count_ = 0;
}

int64_t ParticleTracer::trace(uint32_t index, uint32_t first, uint32_t end,
                              const SplatCanvas& canvas, std::vector<Splat>& splats) const {
  int64_t rays = 0;
  for (uint32_t i = first; i < end; ++i) {
    Sampler sampler(sampler_, seed_, {particle_column, static_cast<int>(index)}, i);
    Particle particle(*scene_, rules_, source_, sampler);
    bool goes_on = particle.emit(static_cast<float>(count_));
    while (goes_on && particle.scatter() && (goes_on = particle.advance()))
      particle.connect(canvas, splats);
    rays += particle.rays() + start_cost;
  }
  return rays;
}

}  // namespace tyndall
