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
  float eta = 1;  ///< relative index of refraction crossed, for Russian roulette
};

/// What eval() and pdf() say of one pair of directions.
struct BsdfValue {
  Rgb value;      ///< f(wo, wi) * |cos wi| [1/sr]
  float pdf = 0;  ///< w.r.t. solid angle [1/sr]
};

// The members of the materials work in the frame of the surface, z along the shading
// normal.

/// Lambertian reflection on both sides.
struct DiffuseBsdf {
  Rgb reflectance;

  bool is_specular() const { return false; }
  BsdfValue evaluate(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u) const;
  Rgb albedo(Vec3 wo) const;
};

/// A metal: GGX microfacets [Walter07] over complex Fresnel reflection, alike on both
/// sides. Light scattered between facets is lost. Smooth below alpha = 0.001.
struct ConductorBsdf {
  Rgb eta, k;
  float alpha_x, alpha_y;

  bool is_specular() const;
  BsdfValue evaluate(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u) const;
  Rgb albedo(Vec3 wo) const;
};

/// Glass: reflects and refracts [Walter07]. Smooth below alpha = 0.001, and if eta is 1.
/// Values are for radiance, which refraction divides by the square of the relative index
/// [Veach97].
struct DielectricBsdf {
  float eta;  ///< index inside (behind the normal) over index outside
  float alpha_x, alpha_y;

  bool is_specular() const;
  BsdfValue evaluate(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u) const;
  Rgb albedo(Vec3 wo) const;
};

/// A medium boundary that light does not notice.
struct InterfaceBsdf {};

using Material = std::variant<DiffuseBsdf, ConductorBsdf, DielectricBsdf, InterfaceBsdf>;

/// A material at a surface point: all vectors in world space, unit, pointing away from it.
///
/// A shading normal `ns` may disagree with the geometric one `ng` on which side of the
/// surface a direction is. Such directions carry nothing, so light never leaks through a
/// closed surface.
class Bsdf {
 public:
  /// `material` must outlive the object. Preconditions: it is not InterfaceBsdf; ns is in
  /// the hemisphere of ng.
  Bsdf(const Material& material, Vec3 ng, Vec3 ns);

  /// Value and density together, at the cost of one of them.
  BsdfValue evaluate(Vec3 wo, Vec3 wi) const;
  /// f(wo, wi) * |cos wi| [1/sr]; zero for specular materials.
  Rgb eval(Vec3 wo, Vec3 wi) const { return evaluate(wo, wi).value; }
  /// Density with which sample() draws wi [1/sr]; zero for specular materials.
  float pdf(Vec3 wo, Vec3 wi) const { return evaluate(wo, wi).pdf; }
  /// Draws wi in rough proportion to eval(). Empty if the light is absorbed.
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u) const;
  /// Whether sample() looks at u_lobe.
  bool chooses_lobe() const { return std::holds_alternative<DielectricBsdf>(*material_); }
  bool is_specular() const;
  /// Reflectance for the albedo layer: exact for diffuse surfaces, the Fresnel reflectance
  /// of a smooth metal, and one for glass, which absorbs nothing.
  Rgb albedo(Vec3 wo) const;

 private:
  /// Whether both normals put `w`, of which `local` is the form in frame_, on the same
  /// side.
  bool sides_agree(Vec3 w, Vec3 local) const { return dot(ng_, w) * local.z > 0; }

  const Material* material_;
  Vec3 ng_;
  Frame frame_;  // z is the shading normal
};

}  // namespace tyndall
