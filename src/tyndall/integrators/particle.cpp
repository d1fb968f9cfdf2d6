// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/particle.h"

#include <algorithm>

#include "tyndall/integrators/leg.h"
#include "tyndall/integrators/particle_ratio.h"

namespace tyndall {

Particle::Particle(const Scene& scene, const ParticleRules& rules,
                   const ParticleSource& source, Sampler& sampler)
    : scene_(scene),
      rules_(rules),
      source_(source),
      sampler_(sampler),
      tracking_(sampler.fork()) {
  if (rules.is_chromatic) hero_ = std::min(static_cast<int>(3 * sampler.next_1d()), 2);
}

bool Particle::emit(float count) {
  const float u_light = sampler_.next_1d();
  const Vec2 u_direction = sampler_.next_2d();
  const std::optional<EmittedParticle> start =
      source_.emit(u_light, u_direction, sampler_.next_2d());
  if (!start) return false;
  ray_ = start->ray;
  ++rays_;
  Leg leg(scene_, ray_, start->medium);
  const SurfaceHit* hit = leg.end();
  if (!hit || !ParticleSource::is_specular(*hit->surface)) return false;
  carried_.beta = start->beta;
  initial_ = max_component(start->beta);
  ratio_ = count * start->density;
  carried_.beta *= transmittance_along(leg, leg.length(), tracking_);
  medium_ = leg.end_medium();
  vertex_.emplace(*hit, -ray_.d, medium_);
  return arrive();
}

bool Particle::arrive() {
  ++depth_;
  return depth_ <= rules_.max_depth && order_ <= rules_.orders.max &&
         !is_black(carried_.beta);
}

bool Particle::advance() {
  ++rays_;
  Leg leg(scene_, ray_, medium_);
  for (size_t i = 0; const Leg::Span* span = leg.span(i); ++i) {
    if (!span->medium) continue;
    const FreeFlight flight = sample_free_flight(
        *span->medium, {ray_.at(span->t_min), ray_.d}, span->t_max - span->t_min, hero_,
        rules_.is_chromatic, carried_, tracking_);
    carried_ = flight.carried;
    if (flight.t) {
      ++order_;
      vertex_.emplace(ray_.at(span->t_min + *flight.t), -ray_.d, span->medium);
      return arrive();
    }
    if (is_black(carried_.beta)) return false;
  }
  const SurfaceHit* hit = leg.end();
  if (!hit) return false;
  vertex_.emplace(*hit, -ray_.d, leg.end_medium());
  return arrive();
}

// Samples of BSDFs are of the radiance that goes to wo(), and particles are radiance over
// the square of the index times area and projected solid angle, by the geometric normal:
// the cosines differ where the shading normal is another [Veach97, Sec. 5.3].
bool Particle::scatter() {
  if (depth_ == rules_.max_depth) return false;
  const std::optional<DirectionSample> s = vertex_->sample(sampler_);
  if (!s) return false;
  const Vec3 wo = vertex_->wo();
  carried_.beta *= s->value * (sqr(s->eta) / s->pdf);
  if (!vertex_->is_in_medium()) {
    const Vec3 ng = vertex_->ng(), ns = vertex_->normal();
    carried_.beta *=
        abs_dot(ng, s->wi) * abs_dot(ns, wo) / (abs_dot(ng, wo) * abs_dot(ns, s->wi));
  }
  ratio_ *= s->is_specular
                ? ParticleRatio::specular(1 / s->eta)
                : ParticleRatio::next(*vertex_, {.to_camera = s->wi,
                                                 .to_light = wo,
                                                 .pdf_to_camera = s->pdf,
                                                 .pdf_to_light = vertex_->pdf_from(s->wi)});
  ray_ = vertex_->spawn(s->wi);
  medium_ = vertex_->medium_towards(scene_, s->wi);
  return survives_roulette();
}

bool Particle::survives_roulette() {
  const float left = max_component(carried_.beta) / average(carried_.spectral) / initial_;
  if (!(left > 0)) return false;
  if (left >= 1) return true;
  if (tracking_.next_1d() >= left) return false;
  carried_.beta /= left;
  return true;
}

// Of the light that arrived along the last leg, towards w; per flux that arrived.
Rgb Particle::scattered_to(Vec3 w) const {
  const Rgb value = vertex_->eval_from(w);
  if (vertex_->is_in_medium()) return value;
  return value * (abs_dot(vertex_->ng(), w) / abs_dot(vertex_->ng(), vertex_->wo()));
}

void Particle::connect(const SplatCanvas& canvas, std::vector<Splat>& splats) {
  if (vertex_->is_specular() || !rules_.orders.contains(order_)) return;
  const PerspectiveCamera& camera = scene_.camera();
  const bool is_pinhole = !(camera.settings().lens_radius > 0);
  const std::optional<CameraView> view =
      camera.view(vertex_->p(), is_pinhole ? Vec2{} : sampler_.next_2d());
  if (!view || !canvas.is_seen(view->p_film)) return;
  const Vec3 w = -view->ray.d;
  const Rgb scattered = scattered_to(w);
  if (is_black(scattered)) return;
  const Ray shadow = vertex_->spawn(w);
  ++rays_;
  if (scene_.is_occluded(shadow, view->distance * (1 - shadow_shortening))) return;
  const Rgb T = transmittance(scene_, shadow, view->distance,
                              vertex_->medium_towards(scene_, w), tracking_);
  const float ratio = ratio_ * ParticleRatio::first(camera, *vertex_,
                                                    {.to_camera = w,
                                                     .to_light = vertex_->wo(),
                                                     .pdf_to_camera = 0,
                                                     .pdf_to_light = vertex_->pdf_from(w)},
                                                    view->distance);
  const float pixels = camera.pixels_per_solid_angle(view->ray.d) / sqr(view->distance);
  const Rgb value = carried_.beta / average(carried_.spectral) * scattered * T *
                    (pixels * particle_weight(ratio));
  if (!is_black(value)) splats.push_back({view->p_film, value, ratio});
}

}  // namespace tyndall
