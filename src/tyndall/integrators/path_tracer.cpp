// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/path_tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "tyndall/integrators/pilot_points.h"
#include "tyndall/integrators/useful_connections.h"
#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

constexpr uint32_t pilot_paths = 1024;
constexpr uint32_t pretraining_paths = 4096;
// The budget of connections is final from this sample of each pixel on.
constexpr uint32_t last_update = 64;
// Before this sample of each pixel, or before a later one if directions or lit surfaces are
// learned, paths without connections are traced, to compare with.
constexpr uint32_t trial_sample = 4, trial_sample_of_learned = 16;
constexpr uint32_t trial_paths = 1 << 17, trial_batch = 1 << 8;
// What connections cost over what their rays cost: techniques are built for them, and bins
// filled where it is predicted what lights see. Measured on the archetype scenes.
constexpr double overhead = 1.2, overhead_of_visibility = 2.3;
// Connections are given up that leave less of the efficiency of plain paths. Those of first
// samples have not learned much yet.
constexpr double least_efficiency = 0.85;

bool can_be_hit(const Light& light) {
  return light.is_environment() || std::holds_alternative<AreaLight>(light.variant());
}

// See PathRules.
const Medium* filling(const Scene& scene) {
  const Medium* medium = scene.filling_medium();
  const bool is_simple =
      medium && medium->is_homogeneous() && medium->is_grey() && !scene.has_glow();
  return is_simple ? medium : nullptr;
}

PathRules plain_rules(const Scene& scene, const RenderSettings& settings) {
  const std::vector<Medium>& media = scene.description().media;
  return {.max_depth = settings.max_depth,
          .orders = settings.orders,
          .is_chromatic = !std::ranges::all_of(media, &Medium::is_grey),
          .walks_find_light = std::ranges::any_of(media, &Medium::is_emissive) ||
                              std::ranges::any_of(scene.lights(), can_be_hit),
          .filling = filling(scene),
          .connections = nullptr,
          .budget = nullptr};
}

std::string note_on_plain_paths(bool would_learn) {
  const std::string note =
      "no light is near enough to what scatters for connections to help: rendered as by "
      "\"volpath\"";
  return would_learn ? note + ", and nothing was learned" : note;
}

}  // namespace

PathTracer::PathTracer(const Scene& scene, const RenderSettings& settings,
                       const ConnectionSettings& connections)
    : scene_(scene),
      seed_(settings.seed),
      resolution_(settings.resolution),
      rules_(plain_rules(scene, settings)),
      learns_(connections.visibility || connections.direction) {
  if (connections.particles) add_particles(settings);
  plain_rules_ = rules_;
  const UsefulConnections useful = useful_connections(scene, connections);
  if (!useful.settings.single) {
    if (connections.single) notes_.push_back(note_on_plain_paths(learns_));
    return;
  }
  if (!useful.why_unlearned.empty()) notes_.push_back(useful.why_unlearned);
  add_connections(useful.settings);
  if (connections.roulette) learn_worth();
}

void PathTracer::add_connections(const ConnectionSettings& settings) {
  connections_.emplace(scene_, settings);
  rules_.connections = &*connections_;
  if (settings.sky_directions)
    rules_.visibility = plain_rules_.visibility = connections_->visibility();
  rules_.filling = nullptr;
  budget_.emplace(pilot_radiance(), resolution_,
                  connections_->visibility() ? overhead_of_visibility : overhead,
                  least_efficiency);
  rules_.budget = &*budget_;
}

void PathTracer::add_particles(const RenderSettings& settings) {
  particles_.emplace(scene_, settings,
                     ParticleRules{.max_depth = rules_.max_depth,
                                   .orders = rules_.orders,
                                   .is_chromatic = rules_.is_chromatic});
  if (particles_->is_useful())
    rules_.particles = &*particles_;
  else
    particles_.reset();
}

void PathTracer::learn_worth() {
  Bounds3 box;
  for (const Vec3 p : pilot_points(scene_)) box.extend(p);
  if (!box.is_empty()) rules_.worth = &worth_.emplace(box);
}

// Camera rays through all of the picture, apart from those of the pixels.
template <typename Trace>
void PathTracer::for_pilot_rays(PilotRays rays, const Trace& trace) const {
  for (uint32_t i = rays.first; i < rays.end; ++i) {
    Sampler sampler(SamplerKind::sobol, seed_, {-1, -1}, i);
    const Vec2 u = sampler.next_2d();
    const Vec2 p_film{u.x * static_cast<float>(resolution_.x),
                      u.y * static_cast<float>(resolution_.y)};
    trace(scene_.camera().ray(p_film, {0.5f, 0.5f}), sampler,
          Vec2i{static_cast<int>(p_film.x), static_cast<int>(p_film.y)});
  }
}

// The mean luminance of a few paths.
float PathTracer::pilot_radiance() const {
  double sum = 0;
  for_pilot_rays({0, pilot_paths}, [&](const Ray& ray, Sampler& sampler, Vec2i) {
    const float found = luminance(trace(rules_, ray, sampler).sample.L);
    if (std::isfinite(found)) sum += double{found};
  });
  return static_cast<float>(sum / pilot_paths);
}

// The first stage of [Zhou16]: samples of joint sampling as if nothing hid the lights.
void PathTracer::pretrain(DirectionGuiding& guiding) const {
  PathRules rules = rules_;
  rules.budget = nullptr;
  rules.worth = nullptr;
  rules.sees_through = true;
  guiding.start_pretraining();
  for_pilot_rays({0, pretraining_paths}, [&](const Ray& ray, Sampler& sampler, Vec2i) {
    Path path(scene_, rules, ray, sampler);
    do {
      Leg leg(scene_, path.ray(), path.medium());
      path.rehearse(leg);
      if (!path.advance(leg)) break;
    } while (path.scatter());
  });
  guiding.finish_pretraining();
}

uint32_t PathTracer::prepare(uint32_t first, const Deadline& deadline) {
  if (!budget_) return unlimited;
  if (first > 0 && budget_->is_recording()) {
    const bool learns = connections_->guiding() || connections_->lit_surfaces();
    if (!was_tried_ && first >= (learns ? trial_sample_of_learned : trial_sample)) {
      was_tried_ = true;
      record_plain_paths(deadline);
    }
    update();
  }
  if (first >= last_update) budget_->end_recording();
  uint32_t next = unlimited;
  if (first < last_update) next = first == 0 ? 1 : first * 4;
  if (DirectionGuiding* guiding = connections_->guiding()) {
    if (first == 0 && connections_->settings().pretraining) pretrain(*guiding);
    next = std::min(next, guiding->prepare(first));
  }
  return next;
}

void PathTracer::update() {
  const bool paid = budget_->pays();
  budget_->update();
  if (worth_) worth_->update(budget_->price());
  if (!budget_->lit_pays()) connections_->forget_lit_surfaces();
  connections_->update();
  if (paid && !budget_->pays()) give_up_connections();
}

// What walks are worth without connections is to be learned again.
void PathTracer::give_up_connections() {
  if (!worth_) return;
  worth_->clear();
  plain_rules_.budget = &*budget_;
  plain_rules_.worth = &*worth_;
}

void PathTracer::record_plain_paths(const Deadline& deadline) const {
  const auto record = [&](const Ray& ray, Sampler& sampler, Vec2i pixel) {
    const Traced path = trace(plain_rules_, ray, sampler);
    budget_->record_plain_path(budget_->region(pixel),
                               {.value = luminance(path.sample.L), .legs = path.legs});
  };
  parallel_for(trial_paths / trial_batch, [&](size_t i) {
    if (deadline.has_passed()) return;
    const auto first = static_cast<uint32_t>(i) * trial_batch;
    for_pilot_rays({first, first + trial_batch}, record);
  });
}

void PathTracer::report(RenderStatistics& statistics) const {
  for (const std::string& note : notes_) statistics.notes.push_back(note);
  if (rules_.particles)
    statistics.counters["particles"] = static_cast<double>(rules_.particles->count());
  if (budget_) report_connections(statistics);
}

void PathTracer::report_connections(RenderStatistics& statistics) const {
  statistics.counters["connections.single"] = budget_->mean_count(Effort::single, 0);
  statistics.counters["connections.dual"] = budget_->mean_count(Effort::dual, 0);
  if (!budget_->pays())
    statistics.notes.push_back(
        "connections gained less than they cost: there were none after the first samples");
  if (!budget_->lit_pays())
    statistics.notes.push_back(
        "connections to lit surfaces gained less than they cost: there were none after the "
        "first samples");
  if (const LightVisibility* visibility = connections_->visibility()) {
    statistics.counters["visibility.maps"] = static_cast<double>(visibility->maps().size());
    statistics.counters["visibility.bytes"] = static_cast<double>(visibility->memory());
  }
  if (connections_->lit_surfaces())
    statistics.counters["connections.lit"] = budget_->mean_count(Effort::lit_from_leg, 0);
  if (const DirectionGuiding* guiding = connections_->guiding()) {
    guiding->report(statistics);
    if (!guiding->has_learned())
      statistics.notes.push_back("no directions were learned: " + why_no_directions());
  }
}

std::string PathTracer::why_no_directions() const {
  if (rules_.max_depth < 2)
    return fmt::format(
        "they are those between two scattering events, and at most {} is allowed",
        rules_.max_depth);
  if (!connections_->makes_dual())
    return "all lights are at infinity, whose light comes from the same side everywhere";
  return "no light arrived after two scattering events, or too few samples were taken";
}

void PathTracer::dump(GuidingFileWriter& out) const {
  if (!connections_) return;
  if (const LightVisibility* visibility = connections_->visibility())
    for (const auto& [light, map] : visibility->maps()) out.add_map(light, *map);
  if (const DirectionGuiding* guiding = connections_->guiding())
    out.add_records(guiding->records());
}

PathSample PathTracer::Li(const Ray& ray, Sampler& sampler) const {
  const bool is_plain = budget_ && !budget_->pays();
  const Traced path = trace(is_plain ? plain_rules_ : rules_, ray, sampler);
  // Not of pilot and trial paths: particles are weighed against the picture's own.
  if (particles_) particles_->record_walk(path.rays);
  return path.sample;
}

PathTracer::Traced PathTracer::trace(const PathRules& rules, const Ray& ray,
                                     Sampler& sampler) const {
  Path path(scene_, rules, ray, sampler);
  do {
    Leg leg(scene_, path.ray(), path.medium());
    path.connect(leg);
    path.look_at_end(leg);
    if (!path.advance(leg)) break;
    path.estimate_direct();
  } while (path.scatter());
  path.finish();
  return {path.result(), path.legs(), path.rays()};
}

}  // namespace tyndall
