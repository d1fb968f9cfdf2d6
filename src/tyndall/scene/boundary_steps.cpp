// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/boundary_steps.h"

#include <algorithm>

namespace tyndall {

std::optional<BoundaryStep> step_across(const SurfaceCrossing& crossing) {
  const MediumInterface& media = crossing.surface->media;
  if (!media.is_stated || !media.is_transition()) return std::nullopt;
  const bool goes_out = crossing.goes_out;
  return BoundaryStep{.t = crossing.t,
                      .from = goes_out ? media.inside : media.outside,
                      .to = goes_out ? media.outside : media.inside,
                      .surface = crossing.surface};
}

BoundarySteps::BoundarySteps(const Ray& ray, float t_end)
    : size_(std::max({magnitude(ray.o.x), magnitude(ray.o.y), magnitude(ray.o.z)})),
      t_end_(t_end) {}

void BoundarySteps::add(const SurfaceCrossing& crossing) {
  const std::optional<BoundaryStep> step = step_across(crossing);
  if (!step || step->t > t_end_ - tolerance(t_end_)) return;
  // A ray through an edge meets the triangles on both sides of it, but goes through once.
  for (size_t i = steps_.size(); i-- > 0 && are_together(steps_[i], *step);)
    if (steps_[i].surface == step->surface && steps_[i].from == step->from) return;
  // Member by member: loads of what was just stored in other widths would have to wait.
  steps_.push_back(
      {.t = step->t, .from = step->from, .to = step->to, .surface = step->surface});
}

}  // namespace tyndall
