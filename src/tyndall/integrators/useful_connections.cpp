// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/useful_connections.h"

#include <algorithm>
#include <variant>

namespace tyndall {
namespace {

bool hides_light(const Surface& surface) {
  return !std::holds_alternative<InterfaceBsdf>(surface.material) && !surface.emission;
}

bool something_hides_light(const SceneDescription& description) {
  return std::ranges::any_of(description.surfaces, hides_light) ||
         std::ranges::any_of(description.objects, [](const std::vector<Surface>& object) {
           return std::ranges::any_of(object, hides_light);
         });
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

}  // namespace

ConnectionSettings useful_connections(const Scene& scene, ConnectionSettings settings) {
  if (!something_hides_light(scene.description())) {
    settings.visibility = false;
    settings.lit_surfaces = 0;
    settings.min_distance_ratio =
        std::max(settings.min_distance_ratio, ConnectionSettings().min_distance_ratio);
  }
  const Bounds3 box = bounds_of_media(scene.description());
  const bool is_useful = std::ranges::any_of(scene.lights(), [&](const Light& light) {
    return light.extent() &&
           (box.is_empty() || is_near(light, box, settings.min_distance_ratio));
  });
  if (!is_useful) settings.single = settings.dual = settings.direction = false;
  return settings;
}

}  // namespace tyndall
