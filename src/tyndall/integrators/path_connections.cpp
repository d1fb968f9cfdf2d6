// SPDX-License-Identifier: Apache-2.0
// The connections of a path to lights, and their weights.
#include <algorithm>
#include <type_traits>

#include "tyndall/integrators/path.h"
#include "tyndall/integrators/sky_sampling.h"
#include "tyndall/sampling/mis.h"

namespace tyndall {
namespace {

// What the other kinds of connections find is not predicted. What the walk carries alone is
// no prediction: walks survive that are worth more, and carry less.
constexpr float unknown = 0;

}  // namespace

std::optional<SelectedLight> Path::select_light(float u) {
  if (!rules_.connections) return scene_.select_light(u);
  return lights_at_vertex().select(scene_.lights(), u);
}

const LightProbabilities& Path::lights_at_vertex() {
  if (!lights_at_vertex_)
    lights_at_vertex_ = rules_.connections->light_choice().at_point(vertex_->p());
  return *lights_at_vertex_;
}

float Path::light_probability(Vec3 p, size_t light) const {
  if (!rules_.connections) return scene_.light_probability(light);
  return rules_.connections->light_choice().at_point(p).probability(light);
}

// To choose a light with: none is needed where there is no choice.
float Path::number_for_light() {
  if (scene_.lights().size() > 1) return sampler_.next_1d();
  sampler_.skip();
  return 0;
}

// To choose a point of the light with.
Vec2 Path::numbers_on(const Light& light) {
  const bool is_delta = std::visit(
      [](const auto& l) {
        using L = std::remove_cvref_t<decltype(l)>;
        return std::is_same_v<L, PointLight> || std::is_same_v<L, SpotLight> ||
               std::is_same_v<L, DistantLight>;
      },
      light.variant());
  if (!is_delta) return sampler_.next_2d();
  sampler_.skip();
  return {};
}

// Whether paths with so many more vertices in media and on surfaces are wanted.
bool Path::counts(int in_media, int on_surfaces) const {
  return depth_ + in_media + on_surfaces <= rules_.max_depth &&
         rules_.orders.contains(order_ + in_media);
}

Path::Connection Path::connect_to(const Vertex& vertex, const SelectedLight& selected) {
  Connection connection{};
  const std::optional<LightSample> sample = sample_light(
      *selected.light, sky_guide(selected.index), vertex.p(), numbers_on(*selected.light));
  if (!sample || !(sample->pdf > 0)) return connection;
  const Rgb f = vertex.eval(sample->wi);
  if (is_black(f)) return connection;
  const Ray shadow = vertex.spawn(sample->wi);
  connection.light =
      f * arriving(selected, *sample, shadow, vertex.medium_towards(scene_, sample->wi));
  connection.end = {.light = selected.index,
                    .probability = selected.probability,
                    .pdf = sample->pdf,
                    .pdf_direction = sample->is_delta ? 0 : vertex.pdf(sample->wi),
                    .to_light = sample->wi,
                    .distance = sample->distance};
  return connection;
}

// Null for lights that are no environments, too.
const SkyGuide* Path::sky_guide(size_t light) const {
  return rules_.visibility ? rules_.visibility->sky(light) : nullptr;
}

// The light that reaches the start of the ray that goes towards it.
Rgb Path::arriving(const SelectedLight& selected, const LightSample& sample,
                   const Ray& shadow, const Medium* medium) {
  if (selected.index == scene_.volume_light()) {
    Leg leg(scene_, shadow, medium);
    return glow_along(leg, tracking_);
  }
  const float t_max = shadow_length(sample);
  if (!rules_.sees_through && scene_.is_occluded(shadow, t_max)) return Rgb();
  return sample.L * transmittance(scene_, shadow, std::min(sample.distance, far_distance),
                                  medium, tracking_);
}

void Path::estimate_direct() {
  const bool is_done = saw_end_ && !vertex_->is_in_medium();
  if (!is_done) connect_vertex();
}

void Path::connect_vertex() {
  if (vertex_->is_specular()) return;
  if (rules_.connections && rules_.connections->lit_surfaces() &&
      !vertex_->is_in_medium() && counts(0, 1))
    spend(Effort::lit_from_vertex, unknown, [&] { return connect_lit(); });
  if (rules_.connections && rules_.connections->makes_dual() && vertex_->sees_glow() &&
      counts(1))
    spend(Effort::glow, glow_around_lights(), [&] { return connect_glow(); });
  start_block(Step::direct);
  const std::optional<SelectedLight> selected = select_light(number_for_light());
  if (!selected || !counts(0) || is_left_to_connections(selected->index)) return;
  const Connection connection = connect_to(*vertex_, *selected);
  if (is_black(connection.light)) return;
  const float weight = direct_weight(connection.end);
  add(beta_ * connection.light * (weight / (selected->probability * connection.end.pdf)));
}

// Whether next event estimation at the current vertex would have the weight zero.
bool Path::is_left_to_connections(size_t light) {
  if (!rules_.connections || !vertex_->is_in_medium()) return false;
  return leg_->is_forced(light, t_vertex_) || leg_->reaches_single(light, t_vertex_);
}

// Of next event estimation at the current vertex.
float Path::direct_weight(const LightEnd& end) {
  if (!rules_.connections)
    return balance_heuristic(end.probability * end.pdf, end.pdf_direction);
  const TailDensities densities =
      vertex_->is_in_medium()
          ? tail_densities(*rules_.connections, tail_counts(depth_), *leg_before_, start_,
                           *leg_, t_vertex_, end)
          : surface_tail_densities(*rules_.connections, tail_counts(depth_), chain_,
                                   vertex_->p(), end, abs_dot(vertex_->ng(), end.to_light));
  return densities.weight(densities.direct);
}

// Of the walk that, from start_, has hit a light where the light's own sampling has the
// density `light_pdf`. Precondition: start_ is not specular.
float Path::hit_weight(size_t light, float light_pdf, float distance) {
  const LightEnd end{.light = light,
                     .probability = light_probability(start_.p, light),
                     .pdf = light_pdf,
                     .pdf_direction = start_.pdf_direction,
                     .to_light = ray_.d,
                     .distance = distance};
  if (!rules_.connections)
    return balance_heuristic(end.pdf_direction, end.probability * end.pdf);
  const TailDensities densities =
      start_.is_in_medium
          ? tail_densities(*rules_.connections, tail_counts(depth_), *leg_two_before_,
                           start_before_, *leg_before_, start_.t, end)
          : surface_tail_densities(*rules_.connections, tail_counts(depth_), chain_,
                                   start_.p, end, abs_dot(start_.ng, ray_.d));
  return densities.weight(densities.hit);
}

// Remembers the legs that densities of connections need.
void Path::enter(Leg& leg) {
  std::optional<ConnectionLeg>& next = legs_[static_cast<size_t>(depth_) % legs_.size()];
  leg_two_before_ = leg_before_;
  leg_before_ = leg_;
  leg_ = &next.emplace(*rules_.connections, pivots_, leg, depth_ == 0);
}

void Path::connect(Leg& leg) {
  if (!rules_.connections) return;
  enter(leg);
  if (leg_->is_empty()) return;
  const bool has_finite = rules_.connections->light_choice().has_finite_lights();
  if (has_finite && counts(1))
    spend(Effort::single, leg_->light_importance(), [&] { return connect_single(leg); });
  if (counts(1) && leg_->forces_collisions())
    spend(Effort::forced, leg_->proxy().collision_share(),
          [&] { return connect_forced(leg); });
  if (rules_.connections->makes_dual() && counts(2))
    spend(Effort::dual, unknown, [&] { return connect_dual(leg); });
  if (rules_.connections->lit_surfaces() && counts(1, 1))
    spend(Effort::lit_from_leg, unknown, [&] { return connect_lit(leg); });
}

Rgb Path::connect_single(Leg& leg) {
  const std::optional<SelectedLight> selected = leg_->select_light(number_for_light());
  const float u = sampler_.next_1d();
  if (!selected || leg_before_->reaches_dual(start_, selected->index)) return Rgb();
  const ConnectionLeg::Single* single = leg_->single(selected->index);
  if (!single) return Rgb();
  const std::optional<DistanceSample> s = single->sample(u);
  const Medium* medium = s ? leg_->proxy().medium_at(s->t) : nullptr;
  return medium ? connect_at(leg, *s, *medium, *selected, &TailDensities::single) : Rgb();
}

// From a vertex of the leg in `medium` to the light, weighed as that technique's.
Rgb Path::connect_at(Leg& leg, const DistanceSample& s, const Medium& medium,
                     const SelectedLight& selected, float TailDensities::*technique) {
  const Vertex last(leg.ray().at(s.t), -leg.ray().d, &medium);
  const Connection connection = connect_to(last, selected);
  if (is_black(connection.light)) return Rgb();
  const TailDensities densities =
      tail_densities(*rules_.connections, tail_counts(depth_ + 1), *leg_before_, start_,
                     *leg_, s.t, connection.end);
  const Rgb value = transmittance_along(leg, s.t, tracking_) * medium.at(last.p()).sigma_s *
                    connection.light;
  return beta_ * value *
         (densities.weight(densities.*technique) /
          (s.pdf_t * selected.probability * connection.end.pdf));
}

}  // namespace tyndall
