// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/lights/volume_light.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/rgb.h"
#include "tyndall/math/transform.h"
#include "tyndall/sampling/tabulated.h"

namespace tyndall {

/// Light that could arrive at a point, before occlusion and transmittance.
struct LightSample {
  Vec3 wi;  ///< unit, towards the light
  float
      distance;   ///< to the light along wi; infinity for lights at infinity and in volumes
  Rgb L;          ///< radiance; for point-like lights intensity / distance^2; one for
                  ///< volume lights, whose radiance is found by tracking along the line
  float pdf;      ///< of wi w.r.t. solid angle [1/sr]; one for point-like lights
  bool is_delta;  ///< no path can hit the light by chance
  /// Before `distance` already, rounding may make the light hide itself [scene units].
  float rounded_end = 0;
};

/// A point on a light, drawn without regard to who looks at it.
struct LightPoint {
  SurfacePoint
      on;  ///< of point-like lights only `on.p` means something; the normals are zero
  float pdf_area;  ///< density w.r.t. area [1/scene unit^2]; one for point-like lights
                   ///< and in volumes
  bool is_delta;   ///< point-like
};

/// Where a light is and where it shines, conservatively: from within `box`, into directions
/// whose cosine to `axis` is at least `cos_cone`.
struct LightExtent {
  Bounds3 box;
  Vec3 axis;       ///< unit
  float cos_cone;  ///< -1: everywhere
};

/// Radiates intensity I evenly.
struct PointLight {
  Vec3 p;
  Rgb I;  ///< [W/sr]
};

/// A point light confined to a cone, with pbrt's smooth edge.
struct SpotLight {
  Vec3 p;
  Vec3 axis;                ///< unit
  Rgb I;                    ///< on the axis [W/sr]
  float cos_total;          ///< dark outside this cone
  float cos_falloff_start;  ///< full intensity within this one; not below cos_total

  /// Intensity towards the unit vector `w` [W/sr].
  Rgb intensity(Vec3 w) const;
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

/// An equal-area octahedral image around the scene, pbrt-v4's layout [Clarberg08]. Radiance
/// is constant over each pixel, so that directions are drawn exactly in proportion to its
/// mean over the channels.
struct ImageEnvironment {
  /// `pixels` holds resolution^2 finite, non-negative values and is multiplied by `scale`.
  /// Only the rotation of the transform is used.
  ImageEnvironment(const Transform& world_from_light, int resolution,
                   std::vector<Rgb> pixels, float scale);

  /// The pixel of a point of the unit square.
  Rgb lookup(Vec2 p) const;

  Transform world_from_light, light_from_world;
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

/// An area light that rays pass through, and so cannot hit by chance: only sampling finds
/// it.
struct HiddenAreaLight {
  AreaLight area;
};

using LightVariant =
    std::variant<PointLight, SpotLight, DistantLight, ConstantEnvironment, ImageEnvironment,
                 AreaLight, HiddenAreaLight, VolumeLight>;

class Light {
 public:
  template <typename T>
  requires std::is_constructible_v<LightVariant, T>
  explicit Light(T light) : light_(std::move(light)) {}

  /// Draws a direction towards the light from `p`. Empty if the light does not reach p.
  std::optional<LightSample> sample(Vec3 p, Vec2 u) const;
  /// Draws a point on the light, uniform by area, in volumes by emitted power. Empty for
  /// lights at infinity.
  std::optional<LightPoint> sample_point(Vec2 u) const;
  /// What leaves a point of sample_point() towards the unit vector `w`: intensity [W/sr] of
  /// point-like lights, else radiance. Black for lights at infinity and in volumes.
  Rgb emission(const SurfacePoint& on, Vec3 w) const;
  /// Empty for lights at infinity.
  std::optional<LightExtent> extent() const;
  /// Density with which sample() from `from` finds the point `on` of this area light
  /// [1/sr]; zero for other lights.
  float pdf(Vec3 from, const SurfacePoint& on) const;
  /// Density with which sample() draws the direction wi towards this environment [1/sr];
  /// zero for other lights.
  float pdf(Vec3 wi) const;
  /// The numbers with which sample() draws the direction wi towards this environment; zeros
  /// for other lights.
  Vec2 invert(Vec3 wi) const;
  /// Density with which sample() from `from` draws the direction w towards this volume
  /// light [1/sr]; zero for other lights.
  float pdf(Vec3 from, Vec3 w) const;
  /// Radiance that arrives against direction w from infinity; black unless an environment.
  Rgb environment(Vec3 w) const;
  /// Emitted power [W], for the choice between lights; of lights at infinity that which
  /// enters a sphere of `scene_radius`.
  Rgb power(float scene_radius) const;

  bool is_infinite() const;     ///< distant or environment
  bool is_environment() const;  ///< can be hit by a ray that leaves the scene
  const LightVariant& variant() const { return light_; }

 private:
  LightVariant light_;
};

}  // namespace tyndall
