// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "tyndall/math/frame.h"
#include "tyndall/math/rgb.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// A direction drawn from a BSDF.
struct BsdfSample {
  Vec3 wi;           ///< unit, points away from the surface
  Rgb value;         ///< f(wo, wi) * |cos wi| [1/sr]; for specular samples the coefficient
  float pdf;         ///< w.r.t. solid angle [1/sr]; for specular samples the probability
  bool is_specular;  ///< a Dirac delta: eval() and pdf() are zero for it
  bool is_transmission;
  float eta = 1;     ///< relative index of refraction crossed, for Russian roulette
};

/// Lambertian reflection on both sides.
struct DiffuseBsdf {
  Rgb reflectance;
};

/// A metal: GGX microfacets [Walter07] over complex Fresnel reflection; smooth if alpha is 0.
struct ConductorBsdf {
  Rgb eta, k;
  float alpha_x, alpha_y;
};

/// Glass: reflects and refracts; smooth if alpha is 0.
struct DielectricBsdf {
  float eta;  ///< index inside (behind the normal) over index outside
  float alpha_x, alpha_y;
};

/// A medium boundary that light does not notice.
struct InterfaceBsdf {};

using Material = std::variant<DiffuseBsdf, ConductorBsdf, DielectricBsdf, InterfaceBsdf>;

/// A material at a surface point: all vectors in world space, unit, pointing away from it.
class Bsdf {
 public:
  /// Precondition: the material is not InterfaceBsdf.
  Bsdf(const Material& material, Vec3 ng, Vec3 ns);

  /// f(wo, wi) * |cos wi| [1/sr]; zero for specular materials.
  Rgb eval(Vec3 wo, Vec3 wi) const;
  /// Density with which sample() draws wi [1/sr]; zero for specular materials.
  float pdf(Vec3 wo, Vec3 wi) const;
  /// Empty if the light is absorbed.
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u) const;
  bool is_specular() const;
  /// Directional-hemispherical reflectance for the albedo layer, approximately.
  Rgb albedo(Vec3 wo) const;

 private:
  const Material* material_;
  Vec3 ng_;
  Frame frame_;  // z is the shading normal
};

}  // namespace tyndall
