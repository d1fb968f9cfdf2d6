// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/geometry/ray.h"
#include "tyndall/lights/light.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/frame.h"

namespace tyndall {

/// A ray that leaves a light.
struct EmittedRay {
  Ray ray;
  Rgb emission;       ///< intensity, irradiance, or radiance times cosine
  float pdf;          ///< of light point and direction [1/sr, 1/(sr unit^2), or
                      ///< 1/unit^2 across parallel light]
  SurfacePoint on{};  ///< of area lights
};

/// The rays out of a light as points of two unit squares: which way, uniform where the
/// light shines (by the cosine, for flat area lights), and where from. "Which way" is told
/// by the direction in space alone, so that it can be learned. Of parallel light all rays
/// go the same way: there it is which part of a box they shine on.
class EmissionSquare {
 public:
  /// Empty for environments. Parallel light shines on `box`, from beyond `scene_bounds`;
  /// so do points, spots and spheres that are far from it; an empty box: everywhere.
  /// The light must outlive the square.
  static std::optional<EmissionSquare> of(const Light& light, const Bounds3& box,
                                          const Bounds3& scene_bounds);

  EmittedRay emit(Vec2 direction, Vec2 point) const;
  /// The square's point for a ray in the unit direction `w` that arrives at `p`. Shapes
  /// whose normal varies (all but spheres and flat ones) have no such point.
  Vec2 invert(Vec3 w, Vec3 p) const;
  /// Whether invert() may be called.
  bool is_invertible() const { return kind_ != Kind::bent; }
  /// Density of emit() for a point `p` from which the light is in the unit direction
  /// `to_light` at `distance`; see LitSurfaceSampling::densities().
  float density(Vec3 p, Vec3 to_light, float distance) const;
  /// Luminance of all that the light emits [W], for the choice between squares.
  float power(const Bounds3& scene_bounds) const {
    return luminance(light_->power(scene_bounds.radius()));
  }

 private:
  enum class Kind { point, spot, parallel, sphere, flat, bent };

  EmissionSquare(const Light& light, Kind kind, const Frame& frame, float area)
      : light_(&light), kind_(kind), frame_(frame), area_(area) {}

  EmissionSquare aimed(const Bounds3& box, Vec3 p, float radius) const;
  Vec3 direction_in_cone(Vec2 u) const;
  EmittedRay emit_parallel(Vec2 position) const;
  Vec2 position_of(Vec3 p) const;
  EmittedRay emit_sphere(Vec2 direction, Vec2 point) const;
  EmittedRay emit_area(Vec2 direction, Vec2 point) const;
  const AreaLight& area_light() const;

  const Light* light_;
  Kind kind_;
  // z: the axis of the cone, the normal of a flat light, towards parallel light
  Frame frame_;
  float width_ = 2;   // one minus the cosine of the cone's half-angle
  float area_;        // of the light, or across parallel light
  Vec3 center_{};     // of parallel light's box, as far along it as rays start
  float radius_ = 0;  // of the square around it
};

}  // namespace tyndall
