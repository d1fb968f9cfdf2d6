// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/image/splat_canvas.h"
#include "tyndall/integrators/particle_tracer.h"

namespace tyndall {

/// Traces the particles of whole samples on many threads, and adds what they find to a film
/// in an order that does not depend on them.
class ParticlePass {
 public:
  /// `filter` must outlive it.
  ParticlePass(const Filter& filter, const RenderSettings& settings);

  /// Those of the sample `index` of all pixels.
  void run(const ParticleTracer& particles, uint32_t index, Film& film);

 private:
  SplatCanvas canvas_;
  double imaging_ratio_;
  std::vector<std::vector<Splat>> batches_;
};

}  // namespace tyndall
