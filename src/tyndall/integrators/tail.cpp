// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/tail.h"

#include "tyndall/techniques/double_scattering_direction.h"

namespace tyndall {

namespace {

// Density of the dual connection for the last two vertices, without what it has in common
// with a single one.
float dual_density(const ConnectionContext& context, ConnectionLeg& before,
                   const LegStart& x, const ConnectionLeg& leg, size_t light) {
  const ConnectionLeg::Double* dual = before.dual_from(x, light);
  const Medium* medium = dual ? before.proxy().medium_at(x.t) : nullptr;
  if (!medium) return 0;
  const DoubleScatteringDirection direction(context.tables(*medium), x.p, before.ray().d,
                                            *before.pivot(light));
  return dual->pdf_t(x.t) * direction.pdf(leg.ray().d) * before.light_probability(light);
}

}  // namespace

LegStart start_of_leg(const Vertex& vertex, float t, float pdf_direction,
                      bool is_specular) {
  return {.p = vertex.p(),
          .t = t,
          .pdf_direction = pdf_direction,
          .is_specular = is_specular,
          .is_in_medium = vertex.is_in_medium(),
          .ng = vertex.ng(),
          .can_be_lit = vertex.can_be_lit()};
}

TailDensities tail_densities(const ConnectionContext& context, ConnectionLeg& before,
                             const LegStart& x, ConnectionLeg& leg, float t,
                             const LightEnd& end) {
  const float collision = leg.proxy().collision_pdf_t(t);
  TailDensities densities{.direct = collision * end.probability * end.pdf,
                          .hit = collision * end.pdf_direction};
  const ConnectionLeg::Single* single = leg.single(end.light);
  const float last = single ? single->pdf_t(t) * end.pdf : 0;
  if (!(last > 0)) return densities;
  densities.direct = 0;
  const float dual = dual_density(context, before, x, leg, end.light);
  if (!(dual > 0)) {
    densities.single = last * leg.light_probability(end.light);
    return densities;
  }
  densities.dual = dual * last;
  // The walk reaches x otherwise.
  densities.hit *= before.proxy().collision_pdf_t(x.t) * x.pdf_direction;
  return densities;
}

TailDensities surface_tail_densities(const ConnectionContext& context,
                                     const ConnectionLeg& before, const LegStart& x,
                                     const LegStart& y, float distance,
                                     const LightEnd& end) {
  TailDensities densities{.direct = end.probability * end.pdf, .hit = end.pdf_direction};
  const LitSurfaceSampling* lit = context.lit_surfaces();
  if (!lit || x.is_specular || !y.can_be_lit) return densities;
  densities.lit = lit->density(end.light, end.to_light, end.distance);
  float walk = x.pdf_direction / sqr(distance);
  if (x.is_in_medium && densities.lit > 0) {
    const std::optional<ConnectionLeg::Lit> technique = before.lit(y.p, y.ng, end.to_light);
    densities.lit *= technique ? technique->pdf_t(x.t) : 0;
    walk *= before.proxy().collision_pdf_t(x.t);
  }
  densities.direct *= walk;
  densities.hit *= walk;
  return densities;
}

}  // namespace tyndall
