// SPDX-License-Identifier: Apache-2.0
// Connections of a path to surfaces that lights shine on.
#include "tyndall/integrators/path.h"

namespace tyndall {

std::optional<LitPoint> Path::sample_lit_point(size_t place) {
  const float u_choice = sampler_.next_1d();
  const Vec2 u_point = sampler_.next_2d();
  return rules_.connections->lit_surfaces()->sample(place, u_choice, u_point,
                                                    sampler_.next_2d(), tracking_);
}

// Tells which walks out of lights are worth most.
Rgb Path::record(size_t place, const LitPoint& lit, Rgb value) const {
  if (rules_.budget)
    rules_.connections->lit_surfaces()->record(
        place, lit, rules_.budget->relative(luminance(value) / average(spectral_)));
  return value;
}

// From the lit point back to the light.
Rgb Path::transmittance_to_light(const LitPoint& lit, const Medium* medium) {
  Rgb product(1);
  for (int i = lit.surfaces - 1; i >= 0; --i) {
    const LitPoint::Edge& edge = lit.edge[i];
    product *= transmittance(scene_, edge.ray, edge.length, medium, tracking_);
    if (i > 0 && scene_.has_boundaries())
      medium = Leg(scene_, edge.ray, medium).end_medium();
  }
  return product;
}

// Next event estimation from the surface nearest the light.
LightEnd Path::light_end(const LitPoint& lit) const {
  const Light& light = scene_.lights()[lit.light];
  const SurfacePoint& first = lit.first.point;
  const bool is_area = std::holds_alternative<AreaLight>(light.variant());
  return {.light = lit.light,
          .probability = light_probability(first.p, lit.light),
          .pdf = is_area ? light.pdf(first.p, lit.on_light) : 1,
          .pdf_direction = is_area ? abs_dot(first.ns, lit.to_light()) * inv_pi : 0,
          .to_light = lit.to_light(),
          .distance = lit.edge[0].length};
}

// Empty if the point is on its dark side, or hidden from x.
std::optional<Path::LitView> Path::look_at(const LitPoint& lit, const Vertex& x) {
  const Vec3 to_lit = lit.hit.point.p - x.p();
  const float distance = length(to_lit);
  if (!(distance > 0)) return std::nullopt;
  const Vec3 w = to_lit / distance;
  const float cos_view = -dot(w, lit.hit.point.ng);
  const float cos_back = dot(lit.to_previous(), lit.hit.point.ng);
  if (!(cos_view * cos_back > 0)) return std::nullopt;
  const Ray ray = x.spawn(w);
  const float t_max = distance * (1 - shadow_shortening) -
                      rounded_end(x.p(), lit.hit.point.p, lit.hit.point.ng);
  if (scene_.is_occluded(ray, t_max)) return std::nullopt;

  // The lit point reflects: light reaches it through the medium that it leaves it by.
  const Medium* at_x = x.medium_towards(scene_, w);
  const auto [T_xy, at_y] = passage(scene_, ray, distance, at_x, tracking_);
  if (is_black(T_xy)) return std::nullopt;
  const Vertex y(lit.hit, -w, at_y);
  const Rgb T = T_xy * transmittance_to_light(lit, at_y);
  const float turn = cos_view / (sqr(distance) * cos_back);
  return LitView{.w = w,
                 .distance = distance,
                 .light = T * y.eval(lit.to_previous()) * lit.flux * turn};
}

// Of the connection between x and the lit point that it sees; `beyond` are the edges of the
// walk to x.
float Path::lit_weight(const LitPoint& lit, int vertices, float edge,
                       const LitChain& beyond) {
  LitChain chain = lit.chain;
  for (int i = 0; i < chain.size; ++i)
    chain.edge[i] *= rules_.connections->filling_transmittance(lit.edge[i + 1].length);
  chain.push_back(edge);
  const bool is_whole = chain.size + beyond.size <= max_lit_surfaces;
  for (int i = 0; i < beyond.size; ++i) chain.push_back(beyond.edge[i]);
  chain.is_seen_from_leg = is_whole && beyond.is_seen_from_leg;
  const TailDensities densities = surface_tail_densities(
      *rules_.connections, tail_counts(vertices), chain, lit.first.point.p, light_end(lit),
      abs_dot(lit.first.point.ng, lit.to_light()));
  return lit_share_ = densities.weight(densities.lit[lit.surfaces - 1]);
}

Rgb Path::connect_lit(Leg& leg) {
  const size_t place = counts_.lit_place(Effort::lit_from_leg, depth_);
  const std::optional<LitPoint> lit = sample_lit_point(place);
  const float u = sampler_.next_1d();
  if (!lit || !counts(1, lit->surfaces)) return Rgb();
  const SurfacePoint& y = lit->hit.point;
  const std::optional<ConnectionLeg::Lit> technique =
      leg_->lit(y.p, y.ng, lit->to_previous());
  const std::optional<DistanceSample> s =
      technique ? technique->sample(u) : std::optional<DistanceSample>();
  const Medium* medium = s ? leg_->proxy().medium_at(s->t) : nullptr;
  if (!medium) return Rgb();
  const Vertex x(leg.ray().at(s->t), -leg.ray().d, medium);
  const std::optional<LitView> view = look_at(*lit, x);
  if (!view || is_black(view->light)) return Rgb();
  const float T = rules_.connections->filling_transmittance(view->distance);
  const float edge = T * x.pdf(view->w) * abs_dot(y.ng, view->w) / sqr(view->distance) *
                     leg_->proxy().collision_pdf_t(s->t) / s->pdf_t;
  const Rgb scattered = transmittance_along(leg, s->t, tracking_) *
                        medium->at(x.p()).sigma_s * x.eval(view->w);
  const float weight =
      lit_weight(*lit, depth_ + 1 + lit->surfaces, edge, {.is_seen_from_leg = true});
  return record(place, *lit, beta_ * scattered * view->light * (weight / s->pdf_t));
}

Rgb Path::connect_lit() {
  const size_t place = counts_.lit_place(Effort::lit_from_vertex, depth_);
  const std::optional<LitPoint> lit = sample_lit_point(place);
  if (!lit || !counts(0, lit->surfaces)) return Rgb();
  const std::optional<LitView> view = look_at(*lit, *vertex_);
  if (!view || is_black(view->light)) return Rgb();
  const float edge =
      edge_density(start_of_leg(*vertex_, t_vertex_, vertex_->pdf(view->w), false), *leg_,
                   lit->hit.point, view->w, view->distance);
  return record(place, *lit,
                beta_ * vertex_->eval(view->w) * view->light *
                    lit_weight(*lit, depth_ + lit->surfaces, edge, chain_));
}

// The density with which the walk goes from x, at x.t of the leg `before`, to the surface
// point y in direction w; where a connection from that leg puts x elsewhere, over that
// connection's density.
float Path::edge_density(const LegStart& x, const ConnectionLeg& before,
                         const SurfacePoint& y, Vec3 w, float distance) const {
  const float T = rules_.connections->filling_transmittance(distance);
  if (x.can_be_lit) return T * diffuse_edge_density(x.ng, y.ng, w, distance);
  const float edge = T * x.pdf_direction * abs_dot(y.ng, w) / sqr(distance);
  if (!x.is_in_medium) return edge;
  const std::optional<ConnectionLeg::Lit> technique = before.lit(y.p, y.ng, -w);
  const float pdf_t = technique ? technique->pdf_t(x.t) : 0;
  return pdf_t > 0 ? edge * before.proxy().collision_pdf_t(x.t) / pdf_t : infinity;
}

// The edges that the walk went to the vertex, for connections to lit points that would have
// met it.
LitChain Path::chain_to(const Vertex& y, float distance) const {
  if (!rules_.connections || !rules_.connections->lit_surfaces()) return {};
  if (start_.is_specular || !y.can_be_lit()) return {};
  LitChain chain =
      start_.can_be_lit ? chain_ : LitChain{.is_seen_from_leg = start_.is_in_medium};
  chain.push_front(edge_density(start_, *leg_before_, y.point(), ray_.d, distance));
  return chain;
}

}  // namespace tyndall
