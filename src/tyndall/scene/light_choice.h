// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/small_vector.hpp>
#include <optional>
#include <span>
#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/lights/light.h"
#include "tyndall/math/bounds.h"

namespace tyndall {

/// A light drawn from all lights.
struct SelectedLight {
  const Light* light;
  size_t index;
  float probability;
};

/// Probabilities of all lights as seen from one place. Cheap to build for tens of lights.
class LightProbabilities {
 public:
  /// Empty if no light can reach the place.
  std::optional<SelectedLight> select(const std::vector<Light>& lights, float u) const;
  float probability(size_t index) const;
  size_t size() const { return cdf_.size(); }
  /// What all lights together may contribute, as LightChoice measures it, in a unit of no
  /// meaning. Zero where that was not looked at.
  float importance() const { return importance_; }
  /// Each times a factor that is not negative, one for each light, and made to sum to one
  /// again; unchanged if nothing would be left.
  LightProbabilities reweighed(std::span<const float> factors) const;

 private:
  friend class LightChoice;
  boost::container::small_vector<float, 8> cdf_;  // inclusive, last is 1; empty: nothing
  float importance_ = 0;
};

/// Chooses lights by what they may contribute.
///
/// To a point: power over squared distance. To a segment, for light scattered along it:
/// power times the integral of 1/distance^2, the angle that the segment subtends at the
/// light over its distance from the line. Both are softened by the light's own extent and
/// by a small share of choice by power alone, so that no light that can contribute is ever
/// left out.
class LightChoice {
 public:
  LightChoice() = default;
  LightChoice(const std::vector<Light>& lights, const Bounds3& scene_bounds);

  LightProbabilities at_point(Vec3 p) const;
  /// Finite lights only: lights at infinity have no place for a segment to be near.
  LightProbabilities along(const Ray& ray, float t_min, float t_max) const;
  /// Lights at infinity only, by power: they have no place either. Empty if there are none.
  LightProbabilities at_infinity() const;
  bool has_finite_lights() const { return finite_power_ > 0; }

 private:
  struct Candidate {
    Vec3 center;
    float radius;  // of the light itself
    float power;
    bool is_infinite;
  };
  template <typename Importance>
  LightProbabilities build(float total_power, const Importance& importance) const;

  std::vector<Candidate> candidates_;
  float power_ = 0, finite_power_ = 0;
  float scene_radius_ = 1;
};

}  // namespace tyndall
