// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/particle_tracer.h"

namespace tyndall {
namespace {

// Of the numbers that particles draw: no pixel's.
constexpr int particle_column = -2;

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

void ParticleTracer::trace(uint32_t index, uint32_t first, uint32_t end,
                           const SplatCanvas& canvas, std::vector<Splat>& splats) const {
  for (uint32_t i = first; i < end; ++i) {
    Sampler sampler(sampler_, seed_, {particle_column, static_cast<int>(index)}, i);
    Particle particle(*scene_, rules_, source_, sampler);
    if (!particle.emit(static_cast<float>(count_))) continue;
    while (particle.scatter() && particle.advance()) particle.connect(canvas, splats);
  }
}

}  // namespace tyndall
