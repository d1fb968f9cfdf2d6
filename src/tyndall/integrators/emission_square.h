// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/geometry/ray.h"
#include "tyndall/lights/light.h"
#include "tyndall/math/frame.h"

namespace tyndall {

/// A ray that leaves a light.
struct EmittedRay {
  Ray ray;
  Rgb emission;       ///< intensity, or radiance times cosine
  float pdf;          ///< of light point and direction [1/sr, or 1/(sr unit^2)]
  SurfacePoint on{};  ///< of area lights
};

/// The rays out of a finite light as points of two unit squares: which way, uniform where
/// the light shines (by the cosine, for flat area lights), and where from. "Which way" is
/// told by the direction in space alone, so that it can be learned.
class EmissionSquare {
 public:
  /// Empty for lights at infinity. The light must outlive the square.
  static std::optional<EmissionSquare> of(const Light& light);

  EmittedRay emit(Vec2 direction, Vec2 point) const;
  /// The square's point for a ray in the unit direction `w`. Shapes whose normal varies
  /// (all but spheres and flat ones) have no such point.
  Vec2 invert(Vec3 w) const;
  /// Whether invert() may be called.
  bool is_invertible() const { return kind_ != Kind::bent; }
  /// Density of emit() for a light in the unit direction `to_light` at `distance`; see
  /// LitSurfaceSampling::density().
  float density(Vec3 to_light, float distance) const;

 private:
  enum class Kind { point, spot, sphere, flat, bent };

  EmissionSquare(const Light& light, Kind kind, const Frame& frame, float area)
      : light_(&light), kind_(kind), frame_(frame), area_(area) {}

  EmittedRay emit_sphere(Vec2 direction, Vec2 point) const;
  EmittedRay emit_area(Vec2 direction, Vec2 point) const;
  const AreaLight& area_light() const;

  const Light* light_;
  Kind kind_;
  Frame frame_;  // z: the axis of a spot light, the normal of a flat one
  float area_;
};

}  // namespace tyndall
