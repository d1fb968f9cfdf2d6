// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/tail.h"

#include "tyndall/techniques/double_scattering_direction.h"

namespace tyndall {

TailDensities tail_densities(const ConnectionContext& context, ConnectionLeg& before,
                             const LegStart& x, ConnectionLeg& leg, float t,
                             const LightEnd& end) {
  const float collision = leg.proxy().collision_pdf_t(t);
  TailDensities densities{.direct = collision * end.probability * end.pdf,
                          .hit = collision * end.pdf_direction};
  const ConnectionLeg::Single* single = leg.single(end.light);
  if (!single) return densities;
  const float last = single->pdf_t(t) * end.pdf;
  densities.single = last * leg.light_probability(end.light);

  const ConnectionLeg::Double* dual =
      x.is_in_medium && !x.is_specular ? before.dual(end.light) : nullptr;
  if (!dual) return densities;
  const Medium* medium = before.proxy().medium_at(x.t);
  if (!medium) return densities;
  const DoubleScatteringDirection direction(context.tables(*medium), x.p, before.ray().d,
                                            *before.pivot(end.light));
  densities.dual = dual->pdf_t(x.t) * direction.pdf(leg.ray().d) * last *
                   before.light_probability(end.light);
  // The others reach x by the walk.
  const float walk = before.proxy().collision_pdf_t(x.t) * x.pdf_direction;
  densities.direct *= walk;
  densities.hit *= walk;
  densities.single *= walk;
  return densities;
}

}  // namespace tyndall
