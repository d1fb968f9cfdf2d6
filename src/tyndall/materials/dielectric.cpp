// SPDX-License-Identifier: Apache-2.0
#include "tyndall/materials/bsdf.h"
#include "tyndall/materials/fresnel.h"
#include "tyndall/materials/ggx.h"

namespace tyndall {
namespace {

BsdfValue evaluate_reflection(const Ggx& ggx, Vec3 wo, Vec3 wi, Vec3 m, float reflected) {
  const float value =
      reflected * ggx.density(m) * ggx.visibility(wo, wi) / (4 * magnitude(wo.z));
  return {Rgb(value), reflected * ggx.visible_density(wo, m) / (4 * abs_dot(wo, m))};
}

// `eta` is the index on the side of wi over that on the side of wo.
BsdfValue evaluate_refraction(const Ggx& ggx, Vec3 wo, Vec3 wi, Vec3 m, float eta,
                              float transmitted) {
  // How far m turns when wi turns: the Jacobian of the half vector [Walter07, Eq. 17].
  const float jacobian = abs_dot(wi, m) / sqr(dot(wi, m) + dot(wo, m) / eta);
  const float value = transmitted * ggx.density(m) * ggx.visibility(wo, wi) * jacobian *
                      abs_dot(wo, m) / (magnitude(wo.z) * sqr(eta));
  return {Rgb(value), transmitted * ggx.visible_density(wo, m) * jacobian};
}

std::optional<BsdfSample> sample_smooth(float eta, Vec3 wo, float u_lobe) {
  const float reflected = dielectric_fresnel(wo.z, eta);
  if (u_lobe < reflected)
    return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                      .value = Rgb(reflected),
                      .pdf = reflected,
                      .is_specular = true,
                      .is_transmission = false};
  const std::optional<Refraction> r = refract(wo, {0, 0, 1}, eta);
  if (!r) return std::nullopt;
  return BsdfSample{.wi = r->wi,
                    .value = Rgb((1 - reflected) / sqr(r->eta)),
                    .pdf = 1 - reflected,
                    .is_specular = true,
                    .is_transmission = true,
                    .eta = r->eta};
}

}  // namespace

bool DielectricBsdf::is_specular() const {
  return eta == 1 || Ggx::is_smooth(alpha_x, alpha_y);
}

BsdfValue DielectricBsdf::evaluate(Vec3 wo, Vec3 wi) const {
  if (wo.z == 0 || wi.z == 0) return {};
  const bool reflects = wo.z * wi.z > 0;
  const float eta_i = reflects   ? 1
                      : wo.z > 0 ? eta
                                 : 1 / eta;  // side of wi over side of wo
  Vec3 m = wo + wi * eta_i;
  if (!(length_squared(m) > 0)) return {};
  m = normalize(m.z < 0 ? -m : m);
  // A facet is seen by both directions from the side on which they are of the surface.
  if (!(dot(m, wo) * wo.z > 0 && dot(m, wi) * wi.z > 0)) return {};
  const Ggx ggx(alpha_x, alpha_y);
  const float reflected = dielectric_fresnel(dot(wo, m), eta);
  return reflects ? evaluate_reflection(ggx, wo, wi, m, reflected)
                  : evaluate_refraction(ggx, wo, wi, m, eta_i, 1 - reflected);
}

std::optional<BsdfSample> DielectricBsdf::sample(Vec3 wo, float u_lobe, Vec2 u) const {
  if (is_specular()) return sample_smooth(eta, wo, u_lobe);
  const Vec3 m = Ggx(alpha_x, alpha_y).sample_visible(wo, u);
  const bool reflects = u_lobe < dielectric_fresnel(dot(wo, m), eta);
  Refraction r{.wi = normalize(m * (2 * dot(wo, m)) - wo), .eta = 1};
  if (!reflects) {
    const std::optional<Refraction> refracted = refract(wo, m, eta);
    if (!refracted) return std::nullopt;
    r = *refracted;
  }
  if (reflects != (wo.z * r.wi.z > 0))
    return std::nullopt;  // scattered again between facets
  const BsdfValue v = evaluate(wo, r.wi);
  return BsdfSample{.wi = r.wi,
                    .value = v.value,
                    .pdf = v.pdf,
                    .is_specular = false,
                    .is_transmission = !reflects,
                    .eta = r.eta};
}

Rgb DielectricBsdf::albedo(Vec3) const { return Rgb(1); }

}  // namespace tyndall
