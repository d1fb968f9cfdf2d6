// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/rgb.h"
#include "tyndall/math/transform.h"
#include "tyndall/sampling/tabulated.h"

namespace tyndall {

/// Light that could arrive at a point, before occlusion and transmittance.
struct LightSample {
  Vec3 wi;         ///< unit, towards the light
  float distance;  ///< to the light along wi; infinity for lights at infinity
  Rgb L;           ///< radiance; for point-like lights intensity / distance^2
  float pdf;       ///< of wi w.r.t. solid angle [1/sr]; one for point-like lights
  bool is_delta;   ///< no path can hit the light by chance
};

/// Radiates intensity I evenly.
struct PointLight {
  Vec3 p;
  Rgb I;  ///< [W/sr]
};

/// A point light confined to a cone, with pbrt's smooth edge.
struct SpotLight {
  Vec3 p;
  Vec3 axis;  ///< unit
  Rgb I;      ///< on the axis [W/sr]
  float cos_total, cos_falloff_start;
};

/// Parallel light from infinitely far.
struct DistantLight {
  Vec3 wi;  ///< unit, towards the light
  Rgb L;    ///< irradiance on a surface that faces it
};

/// The same radiance from everywhere.
struct ConstantEnvironment {
  Rgb L;
};

/// An equal-area octahedral image around the scene, pbrt-v4's layout [Clarberg08].
struct ImageEnvironment {
  ImageEnvironment(Transform world_from_light, int resolution, std::vector<Rgb> pixels, float scale);

  Transform world_from_light;
  int resolution;           ///< pixels per side
  std::vector<Rgb> pixels;  ///< row 0 first, scaled
  PiecewiseConstant2D distribution;
};

/// A shape whose surface emits the same radiance everywhere.
struct AreaLight {
  const Shape* shape;  ///< must outlive the light; in world space
  Rgb L;
  bool two_sided;

  /// Radiance that leaves the surface point towards `w` (pointing away from it).
  Rgb Le(const SurfacePoint& on, Vec3 w) const {
    return two_sided || dot(on.ng, w) > 0 ? L : Rgb{};
  }
};

using LightVariant =
    std::variant<PointLight, SpotLight, DistantLight, ConstantEnvironment, ImageEnvironment, AreaLight>;

class Light {
 public:
  template <typename T>
  explicit Light(T light) : light_(std::move(light)) {}

  /// Draws a direction towards the light from `p`. Empty if the light does not reach p.
  std::optional<LightSample> sample(Vec3 p, Vec2 u) const;
  /// Density with which sample() from `from` finds the point `on` of this area light [1/sr].
  float pdf(Vec3 from, const SurfacePoint& on) const;
  /// Density with which sample() draws the direction wi towards this light at infinity [1/sr].
  float pdf(Vec3 wi) const;
  /// Radiance that arrives against direction w from infinity; black unless an environment.
  Rgb environment(Vec3 w) const;
  /// Emitted power, for the choice between lights [W]; needs the scene's radius for lights at
  /// infinity.
  Rgb power(float scene_radius) const;

  bool is_infinite() const;     ///< distant or environment
  bool is_environment() const;  ///< can be hit by a ray that leaves the scene
  const LightVariant& variant() const { return light_; }

 private:
  LightVariant light_;
};

}  // namespace tyndall
