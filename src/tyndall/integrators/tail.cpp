// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/tail.h"

#include "tyndall/integrators/dual_direction.h"

namespace tyndall {

namespace {

// Density of the dual connection for the last two vertices, without what it has in common
// with a single one.
float dual_density(const ConnectionContext& context, ConnectionLeg& before,
                   const LegStart& x, const ConnectionLeg& leg, size_t light) {
  const bool is_reached = before.reaches_dual(x, light);
  const Medium* medium = is_reached ? before.proxy().medium_at(x.t) : nullptr;
  if (!medium) return 0;
  const DualDirection direction =
      dual_direction(context, *medium, x.p, before.ray().d, light, *before.pivot(light));
  return before.dual(light)->pdf_t(x.t) * direction.pdf(leg.ray().d) *
         before.light_probability(light);
}

// Density with which a connection to glow from the surface x chooses the light and the
// direction of the leg.
float glow_density(const ConnectionContext& context, const LegStart& x,
                   const ConnectionLeg& leg, size_t light) {
  if (x.is_specular || !x.sees_glow || !context.settings().dual) return 0;
  const std::optional<Vec3> pivot = leg.pivot(light);
  if (!pivot) return 0;
  return glow_direction(context, x.medium, x.p, x.ng, light, *pivot).pdf(leg.ray().d) *
         context.light_choice().at_point(x.p).probability(light);
}

}  // namespace

LegStart start_of_leg(const Vertex& vertex, float t, float pdf_direction,
                      bool is_specular) {
  return {.p = vertex.p(),
          .t = t,
          .pdf_direction = pdf_direction,
          .is_specular = is_specular,
          .is_in_medium = vertex.is_in_medium(),
          .ng = vertex.ng_to_wo(),
          .can_be_lit = vertex.can_be_lit(),
          .sees_glow = vertex.sees_glow(),
          .medium = vertex.medium()};
}

TailDensities tail_densities(const ConnectionContext& context, const TailCounts& counts,
                             ConnectionLeg& before, const LegStart& x, ConnectionLeg& leg,
                             float t, const LightEnd& end) {
  // After the same walk; its density, which the proxy may take for zero, is left out.
  TailDensities densities{.direct = end.probability * end.pdf, .hit = end.pdf_direction};
  const bool is_single = leg.reaches_single(end.light, t);
  if (!is_single && !leg.is_forced(end.light, t)) return densities;
  densities.hit *= leg.proxy().collision_pdf_t(t);
  if (!is_single) {
    const ConnectionLeg::Forced* forced = leg.forced(end.light);
    densities.direct = 0;
    densities.forced = forced ? forced->pdf_t(t) * leg.forced_light_probability(end.light) *
                                    end.pdf * counts(Effort::forced, 1)
                              : 0;
    return densities;
  }
  const float last = leg.single(end.light)->pdf_t(t) * end.pdf;
  const float reached = counts.probability_of_reaching(1, !x.is_in_medium);
  densities.direct = 0;
  const float dual = dual_density(context, before, x, leg, end.light);
  if (!(dual > 0)) {
    densities.single = reached * last * leg.light_probability(end.light) * x.pdf_direction *
                       counts(Effort::single, 1);
    densities.glow =
        last * glow_density(context, x, leg, end.light) * counts(Effort::glow, 1);
    densities.hit *= reached * x.pdf_direction;
    return densities;
  }
  densities.dual = dual * last * counts(Effort::dual, 2);
  // The walk reaches x otherwise.
  densities.hit *= before.proxy().collision_pdf_t(x.t) * x.pdf_direction;
  return densities;
}

TailDensities surface_tail_densities(const ConnectionContext& context,
                                     const TailCounts& counts, const LitChain& chain,
                                     Vec3 p, const LightEnd& end, float cos_light) {
  TailDensities densities{.direct = end.probability * end.pdf, .hit = end.pdf_direction};
  if (chain.size == 0) return densities;
  // The density of a connection across an edge lacks that edge, and has that of the walk
  // out of the light instead; all others are the same both ways.
  LitSurfaceSampling::Places places{};
  for (int i = 0; i < chain.size; ++i) {
    const bool is_from_leg = chain.is_seen_from_leg && i == chain.size - 1;
    const Effort effort = is_from_leg ? Effort::lit_from_leg : Effort::lit_from_vertex;
    const int added = is_from_leg ? i + 2 : i + 1;
    places[i] = counts.lit_place(effort, added);
    densities.lit[i] = counts(effort, added) / chain.edge[i];
  }
  const std::array<float, max_lit_surfaces> first = context.lit_surfaces()->densities(
      places, end.light, p, end.to_light, end.distance, cos_light);
  for (int i = 0; i < chain.size; ++i) densities.lit[i] *= first[i];
  // All but the connection from the first vertex walk on from there.
  const float reached = counts.probability_of_reaching(chain.size, !chain.is_seen_from_leg);
  densities.direct *= reached;
  densities.hit *= reached;
  for (int i = 0; i < chain.size - 1; ++i) densities.lit[i] *= reached;
  return densities;
}

}  // namespace tyndall
