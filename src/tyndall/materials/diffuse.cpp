// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tyndall/materials/bsdf.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {

BsdfValue DiffuseBsdf::evaluate(Vec3 wo, Vec3 wi) const {
  if (!(wo.z * wi.z > 0)) return {};
  const float pdf = cosine_hemisphere_pdf(magnitude(wi.z));
  return {reflectance * pdf, pdf};
}

std::optional<BsdfSample> DiffuseBsdf::sample(Vec3 wo, float, Vec2 u) const {
  Vec3 wi = sample_cosine_hemisphere(u);
  wi.z = std::copysign(wi.z, wo.z);
  const BsdfValue v = evaluate(wo, wi);
  return BsdfSample{.wi = wi,
                    .value = v.value,
                    .pdf = v.pdf,
                    .is_specular = false,
                    .is_transmission = false};
}

Rgb DiffuseBsdf::albedo(Vec3) const { return reflectance; }

}  // namespace tyndall
