// SPDX-License-Identifier: Apache-2.0
// Connections of a surface to the air that glows around lights.
#include "tyndall/integrators/path.h"
#include "tyndall/techniques/double_scattering_direction.h"

namespace tyndall {

// Joint importance sampling of direction and distance from a given vertex [Georgiev13]: a
// walk hardly ever leaves a surface towards the neighbourhood of a lamp, where fog glows
// most.
Rgb Path::connect_glow() {
  const std::optional<SelectedLight> selected =
      select_light(vertex_->p(), sampler_.next_1d());
  const Vec2 u_direction = sampler_.next_2d();
  const float u = sampler_.next_1d();
  const std::optional<Vec3> pivot =
      selected ? pivots_(selected->index) : std::optional<Vec3>();
  if (!pivot) return Rgb();
  const DoubleScatteringDirection technique(
      rules_.connections->tables_around(vertex_->medium()), vertex_->p(), *pivot);
  const std::optional<DoubleDirectionSample> direction = technique.sample(u_direction);
  if (!direction) return Rgb();
  const Rgb f = vertex_->eval(direction->w);
  if (is_black(f)) return Rgb();

  Leg next(scene_, vertex_->spawn(direction->w),
           vertex_->medium_towards(scene_, direction->w));
  ConnectionLeg next_leg(*rules_.connections, pivots_, next);
  const ConnectionLeg::Single* single = next_leg.single(selected->index);
  const std::optional<DistanceSample> s =
      single ? single->sample(u) : std::optional<DistanceSample>();
  const Medium* medium = s ? next_leg.proxy().medium_at(s->t) : nullptr;
  if (!medium) return Rgb();
  const Vertex last(next.ray().at(s->t), -direction->w, medium);
  const Connection connection = connect_to(last, *selected);
  if (is_black(connection.light)) return Rgb();

  const LegStart start =
      start_of_leg(*vertex_, t_vertex_, vertex_->pdf(direction->w), false);
  const TailDensities densities =
      tail_densities(*rules_.connections, *leg_, start, next_leg, s->t, connection.end);
  const Rgb value =
      f * leg_transmittance(next, s->t) * medium->at(last.p()).sigma_s * connection.light;
  const float pdf = selected->probability * direction->pdf * s->pdf_t * connection.end.pdf;
  return beta_ * value * (densities.weight(densities.glow) / pdf);
}

}  // namespace tyndall
