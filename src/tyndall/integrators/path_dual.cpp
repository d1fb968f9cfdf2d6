// SPDX-License-Identifier: Apache-2.0
// Connections of a path to lights through two further scattering vertices.
#include <cmath>

#include "tyndall/integrators/dual_direction.h"
#include "tyndall/integrators/path.h"

namespace tyndall {

// The first vertex of a connection through two, and the direction it goes on in.
struct Path::DualStart {
  SelectedLight light;
  Vec3 pivot;
  Vertex x;
  const Medium* medium;  // in that direction
  float t;               // along the leg to x
  DoubleDirectionSample direction;
};

// What arrives there from that direction.
struct Path::ScatteredOnce {
  Rgb light{};                // over the densities of its vertex and of the light's point
  float weight = 0;           // of multiple importance sampling
  float distance = infinity;  // to the vertex that scattered it
};

Rgb Path::connect_dual(Leg& leg) {
  const std::optional<SelectedLight> selected = leg_->select_light(number_for_light());
  const float u_first = sampler_.next_1d(), u_last = sampler_.next_1d();
  const Vec2 u_direction = sampler_.next_2d();
  const ConnectionLeg::Double* dual = selected ? leg_->dual(selected->index) : nullptr;
  if (!dual) return Rgb();
  const std::optional<DistanceSample> first = dual->sample(u_first);
  const Medium* medium = first ? leg_->proxy().medium_at(first->t) : nullptr;
  if (!medium) return Rgb();
  const Vertex x(leg.ray().at(first->t), -leg.ray().d, medium);
  const Vec3 pivot = *leg_->pivot(selected->index);
  const DualDirection technique = dual_direction(*rules_.connections, *medium, x.p(),
                                                 leg.ray().d, selected->index, pivot);
  const std::optional<DoubleDirectionSample> direction = technique.sample(u_direction);
  if (!direction) return Rgb();
  const DualStart start{*selected, pivot, x, medium, first->t, *direction};
  const ScatteredOnce found = connect_beyond(start, u_last, &TailDensities::dual);
  teach(start, technique, found);
  if (is_black(found.light)) return Rgb();
  const Rgb scattered = transmittance_along(leg, first->t, tracking_) *
                        medium->at(x.p()).sigma_s * x.eval(direction->w);
  const float pdf = first->pdf_t * direction->pdf * selected->probability;
  return beta_ * scattered * found.light * (found.weight / pdf);
}

// Connects a surface to the air that glows around lights, by joint importance sampling of
// direction and distance [Georgiev13]: a walk hardly ever leaves a surface towards the
// neighbourhood of a lamp, where fog glows most.
Rgb Path::connect_glow() {
  const std::optional<SelectedLight> selected = select_light(sampler_.next_1d());
  const Vec2 u_direction = sampler_.next_2d();
  const float u = sampler_.next_1d();
  const std::optional<Vec3> pivot =
      selected ? pivots_(selected->index) : std::optional<Vec3>();
  if (!pivot) return Rgb();
  const DualDirection technique =
      glow_direction(*rules_.connections, vertex_->medium(), vertex_->p(),
                     vertex_->ng_to_wo(), selected->index, *pivot);
  const std::optional<DoubleDirectionSample> direction = technique.sample(u_direction);
  const Rgb f = direction ? vertex_->eval(direction->w) : Rgb();
  if (is_black(f)) return Rgb();
  const DualStart start{*selected, *pivot,
                        *vertex_,  vertex_->medium_towards(scene_, direction->w),
                        t_vertex_, *direction};
  const ScatteredOnce found = connect_beyond(start, u, &TailDensities::glow);
  teach(start, technique, found);
  const float pdf = selected->probability * direction->pdf;
  return beta_ * f * found.light * (found.weight / pdf);
}

// What comes from there to the vertex falls off with the distance from the light, not with
// its square; up to a factor.
float Path::glow_around_lights() { return std::sqrt(lights_at_vertex().importance()); }

void Path::rehearse(Leg& leg) {
  enter(leg);
  if (!leg_->is_empty() && counts(2)) connect_dual(leg);
}

// Follows the direction of the dual connection to its second vertex, and connects that.
Path::ScatteredOnce Path::connect_beyond(const DualStart& start, float u,
                                         float TailDensities::*technique) {
  const Vec3 w = start.direction.w;
  Leg next(scene_, start.x.spawn(w), start.medium);
  ConnectionLeg next_leg(*rules_.connections, pivots_, next);
  const ConnectionLeg::Single* single = next_leg.single(start.light.index);
  const std::optional<DistanceSample> second =
      single ? single->sample(u) : std::optional<DistanceSample>();
  const Medium* medium = second ? next_leg.proxy().medium_at(second->t) : nullptr;
  if (!medium) return {};
  const Vertex y(next.ray().at(second->t), -w, medium);
  const Connection connection = connect_to(y, start.light);
  if (is_black(connection.light)) return {.distance = second->t};
  return {.light = transmittance_along(next, second->t, tracking_) *
                   medium->at(y.p()).sigma_s * connection.light /
                   (second->pdf_t * connection.end.pdf),
          .weight = weight_beyond(start, next_leg, second->t, connection.end, technique),
          .distance = second->t};
}

float Path::weight_beyond(const DualStart& start, ConnectionLeg& next, float t,
                          const LightEnd& end, float TailDensities::*technique) {
  // Single connections and next event estimation leave the path to a dual one; only a walk
  // that hits the light makes it too.
  if (technique == &TailDensities::dual && end.pdf_direction == 0) return 1;
  const int added = technique == &TailDensities::dual ? 2 : 1;
  const LegStart at_x =
      start_of_leg(start.x, start.t, start.x.pdf(start.direction.w), false);
  const TailDensities densities = tail_densities(
      *rules_.connections, tail_counts(depth_ + added), *leg_, at_x, next, t, end);
  return densities.weight(densities.*technique);
}

// Tells the guiding what came of a direction, nothing included.
void Path::teach(const DualStart& start, const DualDirection& technique,
                 const ScatteredOnce& found) {
  const DirectionGuiding* guiding = rules_.connections->guiding();
  if (!guiding) return;
  const uint64_t key = hash(key_, ++lessons_);
  if (!guiding->wants(key)) return;
  const Vec3 w = start.direction.w;
  const Vec3 to_light = start.pivot - start.x.p();
  const float distance = length(to_light);
  const DirectionShares densities = technique.densities(w);
  TrainingSample sample;
  sample.key = key;
  sample.p = start.x.p();
  sample.wi = w;
  sample.light_direction = to_light / distance;
  sample.weight = luminance(found.light) * found.weight / start.direction.pdf;
  sample.pdf = start.direction.pdf;
  sample.phase_pdf = densities[static_cast<size_t>(DirectionTechnique::phase)];
  sample.mixture_pdf = densities[static_cast<size_t>(DirectionTechnique::mixture)];
  sample.joint_pdf = densities[static_cast<size_t>(DirectionTechnique::joint_sampling)];
  sample.scattered = luminance(start.x.eval(w));
  sample.light_distance = distance;
  sample.scatter_distance = found.distance;
  if (start.x.is_in_medium()) {
    LegProxy::Cursor cursor(leg_->proxy());
    cursor.move_to(start.t);
    sample.sigma_t = cursor.sigma_t();
  }
  sample.cluster = guiding->cluster_of(start.light.index);
  guiding->record(sample);
}

}  // namespace tyndall
