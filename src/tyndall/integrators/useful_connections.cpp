// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/useful_connections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tyndall/integrators/leg.h"
#include "tyndall/integrators/lit_surface.h"
#include "tyndall/integrators/pilot_points.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// What is known of visibility can lower variance by about one over the share of the light
// that is not hidden, and makes a sample cost 1.3 to 2.3 times as much. Smoke is no reason
// to trace maps: where a lamp glows in it or beside it, of .25 to 20 optical depths, maps
// of its transmittance gained nothing in the same time. But it is one to learn directions.
constexpr double least_hidden_share = 0.3;
constexpr size_t max_probes = 4096;

bool is_hidden(const Scene& scene, Vec3 p, const Light& light, Vec2 u) {
  const std::optional<LightSample> sample = light.sample(p, u);
  return sample && scene.is_occluded({p, sample->wi}, shadow_length(*sample));
}

// The share of the light that surfaces hide from where it matters for the picture; empty if
// that is nowhere.
std::optional<double> hidden_share(const Scene& scene) {
  std::vector<Vec3> points = pilot_points(scene);
  if (points.empty()) return std::nullopt;
  const size_t step = std::max<size_t>(points.size() / max_probes, 1);
  size_t hidden = 0, probes = 0;
  for (size_t i = 0; i < points.size(); i += step, ++probes) {
    RandomStream random(hash(uint64_t{2}, i));
    const std::optional<SelectedLight> light = scene.select_light(random.next_1d());
    if (light && is_hidden(scene, points[i], *light->light, random.next_2d())) ++hidden;
  }
  return static_cast<double>(hidden) / static_cast<double>(probes);
}

bool something_reflects(const SceneDescription& description) {
  const auto reflects = [](const Surface& s) { return LitSurfaceSampling::finds(s); };
  return std::ranges::any_of(description.surfaces, reflects) ||
         std::ranges::any_of(description.objects, [&](const std::vector<Surface>& object) {
           return std::ranges::any_of(object, reflects);
         });
}

// Whether what surfaces see of media differs much from what joint sampling expects: fog on
// all sides.
bool surfaces_see_smoke(const Scene& scene) {
  const Medium* filling = scene.filling_medium();
  const bool is_smoke = filling ? !filling->is_homogeneous() : scene.has_boundaries();
  return is_smoke && something_reflects(scene.description());
}

// The box that holds all media; empty if they have no known bounds.
Bounds3 bounds_of_media(const SceneDescription& description) {
  Bounds3 box;
  if (description.camera_medium != no_medium || !description.instances.empty()) return box;
  for (const Surface& surface : description.surfaces)
    if (!surface.emission) box.extend(bounds(surface.shape));
  return box;
}

// Whether the distance to the light's middle varies by more than `ratio` within the box.
bool is_near(const Light& light, const Bounds3& box, float ratio) {
  const std::optional<LightExtent> extent = light.extent();
  if (!extent) return false;
  const float distance = length(extent->box.center() - box.center());
  return distance + box.radius() > ratio * (distance - box.radius());
}

// What was asked for, and why the scene gives no reason to learn it.
std::string why_unlearned(const ConnectionSettings& asked, std::optional<double> hidden) {
  const char* what = asked.visibility && asked.direction
                         ? "neither distances nor directions were learned"
                     : asked.visibility ? "no distances were learned"
                                        : "no directions were learned";
  if (!hidden) return fmt::format("{}: camera paths meet neither fog nor smoke", what);
  return fmt::format(
      "{}: surfaces hide {:.0f} % of the light from what the picture shows, and below "
      "{:.0f} % learning gains less than it costs",
      what, std::floor(100 * *hidden), 100 * least_hidden_share);
}

}  // namespace

UsefulConnections useful_connections(const Scene& scene, ConnectionSettings settings) {
  const ConnectionSettings asked = settings;
  const bool learns = settings.visibility || settings.direction;
  const bool is_taught = settings.known_visibility || settings.known_directions;
  std::optional<double> hidden;
  if (learns && !is_taught) hidden = hidden_share(scene);
  if (learns && !is_taught && !(hidden && *hidden >= least_hidden_share)) {
    settings.visibility = settings.far_visibility = false;
    settings.direction = settings.direction && surfaces_see_smoke(scene);
    settings.min_distance_ratio =
        std::max(settings.min_distance_ratio, ConnectionSettings().min_distance_ratio);
  }
  if (scene.description().media.empty()) settings.dual = settings.direction = false;
  if (!something_reflects(scene.description())) settings.lit_surfaces = 0;
  const Bounds3 box = bounds_of_media(scene.description());
  const bool is_useful = std::ranges::any_of(scene.lights(), [&](const Light& light) {
    if (!light.extent()) return settings.visibility && settings.far_visibility;
    return box.is_empty() || is_near(light, box, settings.min_distance_ratio);
  });
  if (!is_useful) settings.single = settings.dual = settings.direction = false;
  const bool is_unlearned = learns && !settings.visibility && !settings.direction;
  return {settings, is_unlearned ? why_unlearned(asked, hidden) : std::string()};
}

}  // namespace tyndall
