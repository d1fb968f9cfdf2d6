// SPDX-License-Identifier: Apache-2.0
// Connections to lights that no point of a leg is near to: those at infinity, and far ones.
#include "tyndall/integrators/path.h"

namespace tyndall {

// What the leg lets through of such a light varies with its transmittance only, so the
// vertex is placed as the walk would place it, but for certain: a walk through thin fog
// mostly goes on without.
Rgb Path::connect_forced(Leg& leg) {
  const std::optional<DistanceSample> s = leg_.proxy().sample(sampler_.next_1d());
  const float u_light = sampler_.next_1d();
  const Medium* medium = s ? leg_.proxy().medium_at(s->t) : nullptr;
  if (!medium) return Rgb();
  const Vertex last(leg.ray().at(s->t), -leg.ray().d, medium);
  const std::optional<SelectedLight> selected = select_light(last.p(), u_light);
  if (!selected) return Rgb();
  if (leg_.reaches_single(selected->index, s->t)) return Rgb();
  const Connection connection = connect_to(last, *selected);
  if (is_black(connection.light)) return Rgb();
  const TailDensities densities =
      tail_densities(*rules_.connections, leg_before_, start_, leg_, s->t, connection.end);
  const Rgb value =
      leg_transmittance(leg, s->t) * medium->at(last.p()).sigma_s * connection.light;
  return beta_ * value *
         (densities.weight(densities.forced) /
          (s->pdf_t * selected->probability * connection.end.pdf));
}

}  // namespace tyndall
