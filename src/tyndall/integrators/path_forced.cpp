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
  const std::optional<SelectedLight> selected = select_light(leg.ray().at(s->t), u_light);
  if (!selected) return Rgb();
  if (leg_.reaches_single(selected->index, s->t)) return Rgb();
  return connect_at(leg, *s, *medium, *selected, &TailDensities::forced);
}

}  // namespace tyndall
