// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "tyndall/image/splat_canvas.h"
#include "tyndall/integrators/deadline.h"
#include "tyndall/integrators/particle_tracer.h"

namespace tyndall {

/// Traces the particles of whole samples on many threads, and adds what they find to a film
/// in an order that does not depend on them.
class ParticlePass {
 public:
  /// `filter` must outlive it.
  ParticlePass(const Filter& filter, const RenderSettings& settings);

  /// To be called before sample `first` of each pixel, with the film so far: finds out, at
  /// fixed samples, how many particles are worth their cost. Returns up to which sample
  /// run() may go on before it wants to be called again. Changes nothing if the deadline
  /// passes.
  uint32_t prepare(ParticleTracer& particles, uint32_t first, const Film& film,
                   const Deadline& deadline);
  /// Traces the particles of the sample `index` of all pixels. If the deadline passes, it
  /// drops them, but for those of sample 0, which stand for all of them then: the light
  /// that they carry is carried by no other means.
  void run(const ParticleTracer& particles, uint32_t index, Film& film,
           const Deadline& deadline);

 private:
  void measure(ParticleTracer& particles, uint32_t samples, const Film& film,
               const Deadline& deadline);
  uint32_t trace(const ParticleTracer& particles, uint32_t index, const Deadline& deadline,
                 const std::function<void(size_t batches)>& take);

  SplatCanvas canvas_;
  double imaging_ratio_;
  float max_component_;  // of splats
  std::vector<std::vector<Splat>> batches_;
  std::vector<int64_t> rays_;  // of each batch
};

}  // namespace tyndall
