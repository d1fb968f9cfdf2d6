// SPDX-License-Identifier: Apache-2.0
#include "tyndall/materials/bsdf.h"
#include "tyndall/materials/fresnel.h"
#include "tyndall/materials/ggx.h"

namespace tyndall {
namespace {

Rgb fresnel(const ConductorBsdf& m, float cosine) {
  return {conductor_fresnel(cosine, m.eta.r, m.k.r),
          conductor_fresnel(cosine, m.eta.g, m.k.g),
          conductor_fresnel(cosine, m.eta.b, m.k.b)};
}

}  // namespace

bool ConductorBsdf::is_specular() const { return Ggx::is_smooth(alpha_x, alpha_y); }

BsdfValue ConductorBsdf::evaluate(Vec3 wo, Vec3 wi) const {
  if (!(wo.z * wi.z > 0)) return {};
  const Ggx ggx(alpha_x, alpha_y);
  const Vec3 m = normalize(wo + wi);
  const float cosine = abs_dot(wo, m);
  if (!(cosine > 0)) return {};
  const float value = ggx.density(m) * ggx.visibility(wo, wi) / (4 * magnitude(wo.z));
  return {fresnel(*this, cosine) * value, ggx.visible_density(wo, m) / (4 * cosine)};
}

std::optional<BsdfSample> ConductorBsdf::sample(Vec3 wo, float, Vec2 u) const {
  if (is_specular())
    return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                      .value = fresnel(*this, magnitude(wo.z)),
                      .pdf = 1,
                      .is_specular = true,
                      .is_transmission = false};
  const Vec3 m = Ggx(alpha_x, alpha_y).sample_visible(wo, u);
  const Vec3 wi = normalize(m * (2 * dot(wo, m)) - wo);
  const BsdfValue v = evaluate(wo, wi);  // zero if wi is below the surface
  return BsdfSample{.wi = wi,
                    .value = v.value,
                    .pdf = v.pdf,
                    .is_specular = false,
                    .is_transmission = false};
}

Rgb ConductorBsdf::albedo(Vec3 wo) const { return fresnel(*this, magnitude(wo.z)); }

}  // namespace tyndall
