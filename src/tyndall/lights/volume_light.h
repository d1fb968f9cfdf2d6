// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/small_vector.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "tyndall/lights/emission_distribution.h"

namespace tyndall {

/// All that glows in the volume of a scene, as one light: directions are drawn towards
/// points that emit, and all emission on the line that a direction finds is its light, from
/// whatever medium it comes [SHZD17]. So the density of a direction says all that multiple
/// importance sampling needs, and overlapping media are nothing special.
///
/// Copies share their tables.
class VolumeLight {
 public:
  /// Precondition: not empty, and one of the parts has power.
  explicit VolumeLight(std::vector<EmissionDistribution> parts);

  /// A direction drawn at a point.
  struct Direction {
    Vec3 w;     ///< unit
    float pdf;  ///< w.r.t. solid angle [1/sr]
  };
  /// Empty if the point drawn is `p` itself.
  std::optional<Direction> sample(Vec3 p, Vec2 u) const;
  /// Density of sample() at `p` [1/sr].
  float pdf(Vec3 p, Vec3 w) const;
  /// A point drawn in proportion to the power emitted there.
  Vec3 sample_point(Vec2 u) const;

  Rgb power() const { return power_; }        ///< emitted, before absorption [W]
  Bounds3 bounds() const { return bounds_; }  ///< of all that emits

 private:
  struct Part {
    EmissionDistribution distribution;
    float power;
    Vec3 center;
    float radius;
  };
  // Cumulative; by power and closeness.
  using Choice = boost::container::small_vector<float, 8>;
  Choice choice_at(Vec3 p) const;

  std::shared_ptr<const std::vector<Part>> parts_;
  Rgb power_;
  Bounds3 bounds_;
};

}  // namespace tyndall
