// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/geometry/ray.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/phase_function.h"

namespace tyndall {

/// The same everywhere.
class HomogeneousMedium {
 public:
  /// Precondition: no coefficient is negative.
  HomogeneousMedium(MediumProperties properties, PhaseFunction phase)
      : properties_(properties), phase_(phase) {}

  /// One segment: the whole ray.
  class Segments {
   public:
    Segments(float t_max, Rgb sigma_t) : segment_{0, t_max, sigma_t, sigma_t} {}
    bool next(MediumSegment& segment) {
      if (done_) return false;
      done_ = true;
      segment = segment_;
      return true;
    }

   private:
    MediumSegment segment_;
    bool done_ = false;
  };

  const MediumProperties& at(Vec3 /*p*/) const { return properties_; }
  Segments segments(const Ray& /*ray*/, float t_max) const {
    return {t_max, properties_.sigma_t()};
  }
  bool is_emissive() const { return !is_black(properties_.sigma_a * properties_.Le); }
  bool is_grey() const {
    return tyndall::is_grey(properties_.sigma_a) && tyndall::is_grey(properties_.sigma_s);
  }
  const PhaseFunction& phase() const { return phase_; }

 private:
  MediumProperties properties_;
  PhaseFunction phase_;
};

}  // namespace tyndall
