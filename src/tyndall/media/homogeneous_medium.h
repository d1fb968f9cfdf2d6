// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/vec3d.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/phase_function.h"

namespace tyndall {

/// The same everywhere.
class HomogeneousMedium {
 public:
  /// Precondition: no coefficient is negative.
  HomogeneousMedium(MediumProperties properties, PhaseFunction phase)
      : properties_(properties), phase_(std::move(phase)) {}

  /// One segment: the whole ray.
  class Segments {
   public:
    Segments(const MediumProperties& properties, float t_max)
        : properties_(properties), t_max_(t_max) {}
    bool next(MediumSegment& segment) {
      if (done_) return false;
      done_ = true;
      segment = {0, t_max_, sigma_t(0), sigma_t(0)};
      return !is_black(segment.majorant);
    }
    const MediumProperties& at(float /*t*/) const { return properties_; }
    Rgb sigma_t(float /*t*/) const { return properties_.sigma_t(); }
    Rgb sigma_t_anywhere(float /*t*/) const { return properties_.sigma_t(); }

   private:
    MediumProperties properties_;
    float t_max_;
    bool done_ = false;
  };

  const MediumProperties& at(Vec3 /*p*/) const { return properties_; }
  Segments segments(const Ray& /*ray*/, float t_max) const { return {properties_, t_max}; }
  bool is_emissive() const { return !is_black(properties_.sigma_a * properties_.Le); }
  bool is_grey() const {
    return tyndall::is_grey(properties_.sigma_a) && tyndall::is_grey(properties_.sigma_s);
  }
  void move(Vec3d /*by*/) {}
  size_t memory() const { return 0; }
  const PhaseFunction& phase() const { return phase_; }

 private:
  MediumProperties properties_;
  PhaseFunction phase_;
};

}  // namespace tyndall
