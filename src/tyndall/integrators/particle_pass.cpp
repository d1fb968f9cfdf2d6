// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/particle_pass.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "tyndall/integrators/particle_worth.h"
#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

// Splats of so many particles are kept until they are added.
constexpr uint32_t batch_size = 512, batch_count = 128;
// The numbers of samples after which the worth of particles is measured.
constexpr uint32_t first_measure = 4, last_measure = 16;

}  // namespace

ParticlePass::ParticlePass(const Filter& filter, const RenderSettings& settings)
    : canvas_(filter, settings.crop_min, settings.crop_max),
      imaging_ratio_(double{settings.imaging_ratio}),
      max_component_(settings.max_component),
      batches_(batch_count),
      rays_(batch_count) {}

uint32_t ParticlePass::prepare(ParticleTracer& particles, uint32_t first, const Film& film,
                               const Deadline& deadline) {
  if (first == first_measure || first == last_measure)
    measure(particles, first, film, deadline);
  if (first < first_measure) return first_measure;
  if (first < last_measure) return last_measure;
  particles.end_measuring();
  return std::numeric_limits<uint32_t>::max();
}

// By particles of the last sample, once more.
void ParticlePass::measure(ParticleTracer& particles, uint32_t samples, const Film& film,
                           const Deadline& deadline) {
  if (particles.count() == 0 || deadline.has_passed()) return;
  const ParticleWorth worth(film, canvas_.filter());
  ParticleWorth::Moments sums{};
  double rays = 0;
  const auto take = [&](size_t batches) {
    for (size_t i = 0; i < batches; ++i) {
      const ParticleWorth::Moments moments =
          worth.moments(batches_[i], particles.count(), imaging_ratio_);
      for (size_t k = 0; k < sums.size(); ++k) sums[k] += moments[k];
      rays += static_cast<double>(rays_[i]);
    }
  };
  if (trace(particles, samples - 1, deadline, take) < particles.count()) return;
  particles.change_count(worth.best_share(sums, particles.walk_rays() / samples, rays));
}

void ParticlePass::run(const ParticleTracer& particles, uint32_t index, Film& film,
                       const Deadline& deadline) {
  if (particles.count() == 0) return film.add_no_splats();
  const uint32_t traced = trace(particles, index, deadline, [&](size_t batches) {
    canvas_.add({batches_.data(), batches});
  });
  if (traced == particles.count() || (index == 0 && traced > 0))
    canvas_.give(film, imaging_ratio_ / traced);
  else
    canvas_.clear();
}

// Lets `take` have the first so many batches, each time they are filled. Returns how many
// particles there were before the deadline: it does not depend on what they find.
uint32_t ParticlePass::trace(const ParticleTracer& particles, uint32_t index,
                             const Deadline& deadline,
                             const std::function<void(size_t batches)>& take) {
  const uint32_t count = particles.count();
  // A splat's value times imaging_ratio_ / count is what it adds to a picture of one pixel.
  const auto largest = static_cast<float>(double{max_component_} * count / imaging_ratio_);
  std::atomic<uint32_t> traced = 0;
  for (uint32_t start = 0; start < count; start += batch_size * batch_count) {
    const uint32_t left = count - start;
    const uint32_t batches = std::min((left + batch_size - 1) / batch_size, batch_count);
    parallel_for(batches, [&](size_t i) {
      batches_[i].clear();
      rays_[i] = 0;
      if (deadline.has_passed()) return;
      const uint32_t first = start + static_cast<uint32_t>(i) * batch_size;
      const uint32_t end = first + std::min(batch_size, count - first);
      rays_[i] = particles.trace(index, first, end, canvas_, batches_[i]);
      for (Splat& splat : batches_[i]) splat.value = limited(splat.value, largest);
      traced += end - first;
    });
    take(batches);
    if (deadline.has_passed()) break;
  }
  return traced;
}

}  // namespace tyndall
