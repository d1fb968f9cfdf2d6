// SPDX-License-Identifier: Apache-2.0
// Connections of a path to surfaces that lights shine on.
#include "tyndall/integrators/path.h"

namespace tyndall {

std::optional<LitPoint> Path::sample_lit_point() {
  const float u_light = sampler_.next_1d();
  const Vec2 u_point = sampler_.next_2d();
  return rules_.connections->lit_surfaces()->sample(u_light, u_point, sampler_.next_2d());
}

// Empty if the point is on its dark side, or hidden from x.
std::optional<Path::LitView> Path::look_at(const LitPoint& lit, const Vertex& x) {
  const Vec3 to_lit = lit.hit.point.p - x.p();
  const float distance = length(to_lit);
  if (!(distance > 0)) return std::nullopt;
  const Vec3 w = to_lit / distance;
  const float cos_view = -dot(w, lit.hit.point.ng);
  const float cos_light = dot(lit.to_light, lit.hit.point.ng);
  if (!(cos_view * cos_light > 0)) return std::nullopt;
  const Ray ray = x.spawn(w);
  const float t_max = distance * (1 - shadow_shortening);
  if (scene_.is_occluded(ray, t_max)) return std::nullopt;

  // The lit point reflects: light reaches it through the medium that it leaves it by.
  const Medium* at_x = x.medium_towards(scene_, w);
  const Medium* at_y = scene_.has_boundaries() ? Leg(scene_, ray, at_x).end_medium() : at_x;
  const Vertex y(lit.hit, -w, at_y);
  const Rgb T = transmittance(scene_, ray, t_max, at_x, tracking_) *
                transmittance(scene_, y.spawn(lit.to_light), lit.distance, at_y, tracking_);
  const Light& light = scene_.lights()[lit.light];
  const bool is_area = std::holds_alternative<AreaLight>(light.variant());
  const LightEnd end{.light = lit.light,
                     .probability = light_probability(y.p(), lit.light),
                     .pdf = is_area ? light.pdf(y.p(), lit.on_light) : 1,
                     .pdf_direction = is_area ? y.pdf(lit.to_light) : 0,
                     .to_light = lit.to_light,
                     .distance = lit.distance};
  const float turn = cos_view / (sqr(distance) * cos_light);
  return LitView{.w = w,
                 .distance = distance,
                 .light = T * y.eval(lit.to_light) * lit.emission * (turn / lit.pdf),
                 .y = start_of_leg(y, distance, 0, false),
                 .end = end};
}

Rgb Path::connect_lit(Leg& leg) {
  const std::optional<LitPoint> lit = sample_lit_point();
  const float u = sampler_.next_1d();
  if (!lit) return Rgb();
  const std::optional<ConnectionLeg::Lit> technique =
      leg_.lit(lit->hit.point.p, lit->hit.point.ng, lit->to_light);
  const std::optional<DistanceSample> s =
      technique ? technique->sample(u) : std::optional<DistanceSample>();
  const Medium* medium = s ? leg_.proxy().medium_at(s->t) : nullptr;
  if (!medium) return Rgb();
  const Vertex x(leg.ray().at(s->t), -leg.ray().d, medium);
  const std::optional<LitView> view = look_at(*lit, x);
  if (!view || is_black(view->light)) return Rgb();
  const LegStart start = start_of_leg(x, s->t, x.pdf(view->w), false);
  const TailDensities densities = surface_tail_densities(
      *rules_.connections, leg_, start, view->y, view->distance, view->end);
  const Rgb scattered =
      leg_transmittance(leg, s->t) * medium->at(x.p()).sigma_s * x.eval(view->w);
  return beta_ * scattered * view->light * (densities.weight(densities.lit) / s->pdf_t);
}

Rgb Path::connect_lit() {
  if (depth_ + 1 > rules_.max_depth || !rules_.orders.contains(order_)) return Rgb();
  const std::optional<LitPoint> lit = sample_lit_point();
  if (!lit) return Rgb();
  const std::optional<LitView> view = look_at(*lit, *vertex_);
  if (!view || is_black(view->light)) return Rgb();
  const LegStart start = start_of_leg(*vertex_, t_vertex_, vertex_->pdf(view->w), false);
  const TailDensities densities = surface_tail_densities(
      *rules_.connections, leg_, start, view->y, view->distance, view->end);
  return beta_ * vertex_->eval(view->w) * view->light * densities.weight(densities.lit);
}

}  // namespace tyndall
