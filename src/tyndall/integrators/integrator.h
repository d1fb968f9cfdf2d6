// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "tyndall/guiding/guiding_file.h"
#include "tyndall/image/film.h"
#include "tyndall/integrators/deadline.h"
#include "tyndall/integrators/render.h"
#include "tyndall/sampling/sampler.h"

namespace tyndall {

class ParticleTracer;

/// Estimates the radiance along camera rays. One render, one integrator.
class Integrator {
 public:
  static constexpr uint32_t unlimited = std::numeric_limits<uint32_t>::max();

  virtual ~Integrator() = default;

  /// An unbiased estimate of the radiance that arrives against ray.d. Called from many
  /// threads; depends on nothing but its arguments and what prepare() left.
  virtual PathSample Li(const Ray& ray, Sampler& sampler) const = 0;

  /// Called between passes, before sample `first` of each pixel, on no other thread's time.
  /// An integrator that learns does so here. Returns up to which sample it may go on before
  /// it wants to be called again; a function of `first` alone, so that time limits change
  /// nothing. May leave its work when the deadline passes: unless `first` is 0, there are
  /// no samples after it.
  virtual uint32_t prepare(uint32_t /*first*/, const Deadline& /*deadline*/) {
    return unlimited;
  }

  /// Particles out of lights that find what Li() leaves to them; null if there are none.
  /// Those of as many samples as Li() is asked for are to be traced.
  virtual ParticleTracer* particles() { return nullptr; }

  /// Adds counters and notes.
  virtual void report(RenderStatistics& /*statistics*/) const {}

  /// Whether it learns in scenes that give reason to.
  virtual bool learns() const { return false; }
  /// Writes what it has learned, which may be nothing.
  virtual void dump(GuidingFileWriter& /*out*/) const {}
};

/// Throws std::invalid_argument for an unknown name or option.
std::unique_ptr<Integrator> make_integrator(const Scene& scene,
                                            const RenderSettings& settings);

}  // namespace tyndall
