// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/path.h"

#include <algorithm>

#include "tyndall/integrators/free_flight.h"
#include "tyndall/integrators/sky_sampling.h"

namespace tyndall {
namespace {

// Paths this short are never ended by chance.
constexpr int roulette_free_depth = 1;
// A walk that seems worth nothing may be all that finds something rare.
constexpr float least_survival = 0.1f;
// Ends of legs that are seen less clearly are left to chance.
constexpr float least_end_transmittance = 0.01f;

// A number of its own for a stream, which stays where it is.
uint64_t key_of(RandomStream stream) {
  const uint64_t high = stream.next_bits();
  return high << 32 | stream.next_bits();
}

}  // namespace

Path::Path(const Scene& scene, const PathRules& rules, const Ray& ray, Sampler& sampler)
    : scene_(scene),
      rules_(rules),
      sampler_(sampler),
      tracking_(sampler.fork()),
      key_(key_of(tracking_)),
      ray_(ray),
      medium_(scene.camera_medium()),
      pivots_(scene, tracking_.next_bits()) {
  start_.p = ray.o;
  if (rules.budget) counts_ = {*rules.budget, sampler.pixel()};
  if (rules.is_chromatic) hero_ = std::min(static_cast<int>(3 * sampler.next_1d()), 2);
}

void Path::look_at_end(Leg& leg) {
  saw_end_ = false;
  if (!rules_.connections || depth_ > 0 || leg_->is_empty()) return;
  const float T = leg_->proxy().transmittance(far_distance);
  saw_end_ = T > least_end_transmittance;
  if (!saw_end_) return;
  probability_of_first_ = T;
  const Rgb beta = beta_;
  const Medium* const medium = medium_;
  beta_ *= transmittance_along(leg, leg.length(), tracking_);
  medium_ = leg.end_medium();
  if (const SurfaceHit* hit = leg.end()) {
    add_surface_emission(*hit);
    vertex_.emplace(*hit, -ray_.d, medium_);
    if (arrive(hit->t)) connect_vertex();
    vertex_.reset();
    depth_ = 0;
  } else {
    add_environment();
  }
  beta_ = beta;
  medium_ = medium;
}

bool Path::advance(Leg& leg) {
  vertex_.reset();
  add_glow(leg);
  if (rules_.filling) {
    if (const std::optional<float> t = fly_freely(leg))
      return meet_medium(*t, rules_.filling);
  } else {
    for (size_t i = 0; const Leg::Span* span = leg.span(i); ++i) {
      if (!span->medium) continue;
      if (const std::optional<float> t = sample_collision(leg.ray(), *span))
        return meet_medium(*t, span->medium);
      if (is_black(beta_)) return false;
    }
  }
  medium_ = leg.end_medium();
  const SurfaceHit* hit = leg.end();
  if (!hit) {
    if (!saw_end_) add_environment();
    return false;
  }
  if (!saw_end_) add_surface_emission(*hit);
  vertex_.emplace(*hit, -ray_.d, medium_);
  return arrive(hit->t);
}

// Draws the free flight first, and follows the ray no farther: empty if it meets a surface.
std::optional<float> Path::fly_freely(Leg& leg) {
  const Rgb beta = beta_;
  const std::optional<float> t =
      sample_collision(leg.ray(), {0, far_distance, rules_.filling});
  if (!t) return std::nullopt;
  leg.limit(*t);
  if (!leg.end()) return t;
  beta_ = beta;
  return std::nullopt;
}

bool Path::meet_medium(float t, const Medium* medium) {
  ++order_;
  vertex_.emplace(ray_.at(t), -ray_.d, medium);
  return arrive(t);
}

// At vertex_, which stands at distance t along the leg. False if the path ends there.
bool Path::arrive(float t) {
  t_vertex_ = t;
  lights_at_vertex_.reset();
  chain_ = chain_to(*vertex_, t);
  if (depth_ == 0) {
    result_.albedo = vertex_->albedo();
    result_.normal = vertex_->normal();
    result_.depth = t;
  }
  ++depth_;
  return depth_ <= rules_.max_depth && order_ <= rules_.orders.max && !is_black(beta_);
}

// Delta tracking. Returns the distance along the leg of the first real collision.
std::optional<float> Path::sample_collision(const Ray& ray, const Leg::Span& span) {
  const FreeFlight flight =
      sample_free_flight(*span.medium, {ray.at(span.t_min), ray.d}, span.t_max - span.t_min,
                         hero_, rules_.is_chromatic, {beta_, spectral_}, tracking_);
  beta_ = flight.carried.beta;
  spectral_ = flight.carried.spectral;
  if (!flight.t) return std::nullopt;
  return span.t_min + *flight.t;
}

// Of the whole leg: what is expected of walks along it, whatever this one does.
void Path::add_glow(Leg& leg) {
  if (!scene_.has_glow() || !rules_.orders.contains(order_)) return;
  const Rgb Le = glow_along(leg, tracking_);
  if (is_black(Le)) return;
  float weight = 1;
  if (const std::optional<size_t> light = scene_.volume_light();
      light && !start_.is_specular)
    weight = hit_weight(*light, scene_.lights()[*light].pdf(start_.p, ray_.d), infinity);
  add(beta_ * Le * weight);
}

void Path::add_surface_emission(const SurfaceHit& hit) {
  if (!hit.light || !rules_.orders.contains(order_)) return;
  const auto* area = std::get_if<AreaLight>(&hit.light->variant());
  const Rgb Le = area->Le(hit.point, -ray_.d);
  if (is_black(Le)) return;
  const float weight =
      start_.is_specular
          ? weight_beside_particles(hit)
          : hit_weight(hit.light_index, hit.light->pdf(start_.p, hit.point), hit.t);
  add(beta_ * Le * weight);
}

void Path::add_environment() {
  if (!rules_.orders.contains(order_)) return;
  for (const size_t i : scene_.environments()) {
    const Light& light = scene_.lights()[i];
    const float weight =
        start_.is_specular
            ? 1
            : hit_weight(i, environment_pdf(light, sky_guide(i), start_.p, ray_.d),
                         infinity);
    add(beta_ * light.environment(ray_.d) * weight);
  }
}

void Path::finish() const {
  if (!rules_.budget || !rules_.budget->is_recording()) return;
  rules_.budget->record_path(sampler_.pixel(), {.value = luminance(result_.L),
                                                .legs = legs(),
                                                .spent = spent_,
                                                .lit_gain = lit_gain_,
                                                .lit_spent = lit_spent_});
  if (rules_.worth) tell_worth();
}

bool Path::scatter() {
  // A last leg could only find what glows.
  if (depth_ == rules_.max_depth && !rules_.walks_find_light) return false;
  start_block(Step::direction);
  const std::optional<DirectionSample> s = vertex_->sample(sampler_);
  if (!s) return false;
  beta_ *= s->value / s->pdf;
  eta_scale_ *= sqr(s->eta);
  if (rules_.particles) particle_ratio_ = particle_ratio(*s);
  start_before_ = start_;
  start_ = start_of_leg(*vertex_, t_vertex_, s->pdf, s->is_specular);
  ray_ = vertex_->spawn(s->wi);
  medium_ = vertex_->medium_towards(scene_, s->wi);
  return survives_roulette();
}

bool Path::survives_roulette() {
  const float carried = max_component(beta_) / average(spectral_) * eta_scale_;
  if (!(carried > 0)) return false;
  const float p = std::min(depth_ <= roulette_free_depth ? 1 : survival(carried), 1.0f);
  if (p < 1) {
    if (tracking_.next_1d() >= p) return false;
    beta_ /= p;
  }
  depart(carried / p);
  return true;
}

// A path goes on with the probability of what it can still carry, as far as nothing better
// is known; in a medium of albedo one it carries all and is never ended.
float Path::survival(float carried) const {
  const WalkWorth* worth = rules_.worth;
  if (!worth || worth->is_empty()) return carried;
  const float wanted = rules_.budget->relative(counts_.region(), carried) /
                       rules_.budget->relative(1) *
                       worth->survival(worth->place(ray_.o, ray_.d));
  return std::max(wanted, least_survival * std::min(carried, 1.0f));
}

void Path::depart(float carried) {
  if (!rules_.worth || !rules_.budget->is_recording()) return;
  if (departed_ == departures_.size()) return;
  departures_[departed_++] = {.place = rules_.worth->place(ray_.o, ray_.d),
                              .carried = carried,
                              .found = luminance(result_.L),
                              .cost = rules_.budget->path_cost(depth_, spent_)};
}

void Path::tell_worth() const {
  const float cost = rules_.budget->path_cost(legs(), spent_);
  for (size_t i = 0; i < departed_; ++i) {
    const Departure& d = departures_[i];
    const float found = (luminance(result_.L) - d.found) / d.carried;
    rules_.worth->record(d.place, rules_.budget->relative(found), cost - d.cost);
  }
}

}  // namespace tyndall
