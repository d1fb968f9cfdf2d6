// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace tyndall {
namespace {

constexpr uint32_t pilot_paths = 1024;
// The budget of connections is final from this sample of each pixel on.
constexpr uint32_t last_update = 64;

bool can_be_hit(const Light& light) {
  return light.is_environment() || std::holds_alternative<AreaLight>(light.variant());
}

}  // namespace

PathTracer::PathTracer(const Scene& scene, const RenderSettings& settings,
                       const ConnectionSettings& connections)
    : scene_(scene),
      rules_{
          .max_depth = settings.max_depth,
          .orders = settings.orders,
          .is_chromatic = !std::ranges::all_of(scene.description().media, &Medium::is_grey),
          .walks_find_light =
              std::ranges::any_of(scene.description().media, &Medium::is_emissive) ||
              std::ranges::any_of(scene.lights(), can_be_hit),
          .connections = nullptr,
          .budget = nullptr} {
  if (!connections.single) return;
  connections_.emplace(scene, connections);
  // Without finite lights there is nothing to connect to.
  if (!connections_->light_choice().has_finite_lights()) return;
  rules_.connections = &*connections_;
  budget_.emplace(pilot_radiance(settings));
  rules_.budget = &*budget_;
}

// The mean luminance of a few paths through all of the picture.
float PathTracer::pilot_radiance(const RenderSettings& settings) const {
  double sum = 0;
  for (uint32_t i = 0; i < pilot_paths; ++i) {
    Sampler sampler(SamplerKind::sobol, settings.seed, {-1, -1}, i);
    const Vec2 u = sampler.next_2d();
    const Vec2 p_film{u.x * static_cast<float>(settings.resolution.x),
                      u.y * static_cast<float>(settings.resolution.y)};
    const float found = luminance(Li(scene_.camera().ray(p_film, {0.5f, 0.5f}), sampler).L);
    if (std::isfinite(found)) sum += double{found};
  }
  return static_cast<float>(sum / pilot_paths);
}

uint32_t PathTracer::prepare(uint32_t first) {
  if (!budget_) return unlimited;
  if (first > 0) {
    budget_->update();
    connections_->update();
  }
  if (first >= last_update) return unlimited;
  return first == 0 ? 1 : first * 4;
}

void PathTracer::report(RenderStatistics& statistics) const {
  if (!budget_) return;
  statistics.counters["connections.single"] = double{budget_->count(Effort::single, 0)};
  statistics.counters["connections.dual"] = double{budget_->count(Effort::dual, 0)};
  if (connections_->lit_surfaces())
    statistics.counters["connections.lit"] =
        double{budget_->count(Effort::lit_from_leg, 0)};
}

PathSample PathTracer::Li(const Ray& ray, Sampler& sampler) const {
  Path path(scene_, rules_, ray, sampler);
  do {
    Leg leg(scene_, path.ray(), path.medium());
    path.connect(leg);
    path.look_at_end(leg);
    if (!path.advance(leg)) break;
    path.estimate_direct();
  } while (path.scatter());
  path.finish();
  return path.result();
}

}  // namespace tyndall
