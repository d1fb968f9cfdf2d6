// SPDX-License-Identifier: Apache-2.0
// Connections to lights that no point of a leg is near to: those at infinity, and far ones.
#include "tyndall/integrators/path.h"

namespace tyndall {

// What the leg lets through of such a light varies with its transmittance, and with what
// hides the light. The vertex is placed as the walk would place it, but for certain, where
// a walk through thin fog mostly goes on without, and rather where the light is predicted.
Rgb Path::connect_forced(Leg& leg) {
  const float u = sampler_.next_1d();
  const std::optional<SelectedLight> selected =
      leg_->select_forced_light(sampler_.next_1d());
  const ConnectionLeg::Forced* forced = selected ? leg_->forced(selected->index) : nullptr;
  const std::optional<DistanceSample> s =
      forced ? forced->sample(u) : std::optional<DistanceSample>();
  const Medium* medium = s ? leg_->proxy().medium_at(s->t) : nullptr;
  if (!medium || leg_->reaches_single(selected->index, s->t)) return Rgb();
  return connect_at(leg, *s, *medium, *selected, &TailDensities::forced);
}

}  // namespace tyndall
