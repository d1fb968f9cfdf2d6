// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/particle_pass.h"

#include <algorithm>

#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

// Splats of so many particles are kept until they are added.
constexpr uint32_t batch_size = 512, batch_count = 128;

}  // namespace

ParticlePass::ParticlePass(const Filter& filter, const RenderSettings& settings)
    : canvas_(filter, settings.crop_min, settings.crop_max),
      imaging_ratio_(double{settings.imaging_ratio}),
      batches_(batch_count) {}

void ParticlePass::run(const ParticleTracer& particles, uint32_t index, Film& film) {
  const uint32_t count = particles.count();
  for (uint32_t start = 0; start < count; start += batch_size * batch_count) {
    const uint32_t left = count - start;
    const uint32_t batches = std::min((left + batch_size - 1) / batch_size, batch_count);
    parallel_for(batches, [&](size_t i) {
      const uint32_t first = start + static_cast<uint32_t>(i) * batch_size;
      const uint32_t end = first + std::min(batch_size, count - first);
      batches_[i].clear();
      particles.trace(index, first, end, canvas_, batches_[i]);
    });
    canvas_.add({batches_.data(), batches});
  }
  canvas_.give(film, imaging_ratio_ / count);
}

}  // namespace tyndall
