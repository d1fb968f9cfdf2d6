// SPDX-License-Identifier: Apache-2.0
#include "tyndall/materials/bsdf.h"

#include <cassert>
#include <type_traits>

namespace tyndall {
namespace {

/// Calls f with the material; an interface scatters nothing and gives an empty result.
template <typename F>
auto visit_scattering(const Material& material, F f) {
  using Result = std::invoke_result_t<F, const DiffuseBsdf&>;
  return std::visit(
      [&](const auto& m) -> Result {
        if constexpr (std::is_same_v<decltype(m), const InterfaceBsdf&>)
          return Result{};
        else
          return f(m);
      },
      material);
}

}  // namespace

Bsdf::Bsdf(const Material& material, Vec3 ng, Vec3 ns)
    : material_(&material), ng_(ng), frame_(Frame::from_z(ns)) {
  assert(!std::holds_alternative<InterfaceBsdf>(material));
}

BsdfValue Bsdf::evaluate(Vec3 wo, Vec3 wi) const {
  const Vec3 local_wo = frame_.to_local(wo), local_wi = frame_.to_local(wi);
  if (!sides_agree(wo, local_wo) || !sides_agree(wi, local_wi)) return {};
  return visit_scattering(*material_, [&](const auto& m) {
    return m.is_specular() ? BsdfValue{} : m.evaluate(local_wo, local_wi);
  });
}

std::optional<BsdfSample> Bsdf::sample(Vec3 wo, float u_lobe, Vec2 u) const {
  const Vec3 local_wo = frame_.to_local(wo);
  if (!sides_agree(wo, local_wo)) return std::nullopt;
  auto s = visit_scattering(*material_,
                            [&](const auto& m) { return m.sample(local_wo, u_lobe, u); });
  if (!s || !(s->pdf > 0) || is_black(s->value)) return std::nullopt;
  const Vec3 local_wi = s->wi;
  s->wi = normalize(frame_.to_world(local_wi));
  if (!sides_agree(s->wi, local_wi)) return std::nullopt;
  return s;
}

bool Bsdf::is_specular() const {
  return visit_scattering(*material_, [](const auto& m) { return m.is_specular(); });
}

Rgb Bsdf::albedo(Vec3 wo) const {
  const Vec3 local_wo = frame_.to_local(wo);
  return visit_scattering(*material_, [&](const auto& m) { return m.albedo(local_wo); });
}

}  // namespace tyndall
