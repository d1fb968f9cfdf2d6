// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/sampling/tabulated.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// A surface point that a finite light shines on, found by a ray out of the light: bright
/// surfaces near a lamp are found as often as they are bright, where a walk hardly ever
/// meets them.
struct LitPoint {
  SurfaceHit hit;
  Vec3 to_light;   ///< unit
  float distance;  ///< to the light
  Rgb emission;  ///< intensity, or radiance times cosine, that leaves the light towards it
  float pdf;     ///< of light, light point and direction [1/sr, or 1/(sr unit^2)]
  size_t light;
  SurfacePoint on_light;  ///< of area lights
};

/// Rays out of finite lights: the light by power, evenly into its cone, from area lights by
/// area and cosine.
class LitSurfaceSampling {
 public:
  explicit LitSurfaceSampling(const Scene& scene);

  /// Whether surfaces like this are found: those that reflect light diffusely.
  static bool finds(const Surface& surface);
  /// Empty if the ray meets no surface that reflects light diffusely.
  std::optional<LitPoint> sample(float u_light, Vec2 u_point, Vec2 u_direction) const;

  /// Density of sample() for a surface point at `distance` from the light, which lies in
  /// the unit direction `to_light`: in the measure of area, up to the factor that turns the
  /// solid angle of next event estimation from there into the light's area (one if it is a
  /// delta).
  float density(size_t light, Vec3 to_light, float distance) const;

 private:
  float probability(size_t light) const;

  const Scene* scene_;
  DiscreteDistribution power_;
  std::vector<float> area_;  // of area lights
};

}  // namespace tyndall
