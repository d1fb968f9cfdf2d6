// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/better_origin.h"

namespace tyndall::loader {
namespace {

// Shapes are far from the origin if it is so many times their radius away: floats are then
// coarser by as much than about their center.
constexpr float far_away = 32;

Bounds3 bounds_of(const std::vector<Surface>& surfaces) {
  Bounds3 box;
  for (const Surface& surface : surfaces) box.extend(bounds(surface.shape));
  return box;
}

Bounds3 bounds_of(const SceneDescription& scene) {
  Bounds3 box = bounds_of(scene.surfaces);
  std::vector<Bounds3> objects;
  for (const std::vector<Surface>& object : scene.objects)
    objects.push_back(bounds_of(object));
  for (const ObjectInstance& instance : scene.instances)
    box.extend(instance.world_from_object.bounds(objects[instance.object]));
  return box;
}

}  // namespace

std::optional<Vec3d> better_origin(const SceneDescription& scene) {
  const Bounds3 box = bounds_of(scene);
  if (box.is_empty() || !is_finite(box.diagonal())) return std::nullopt;
  const Vec3d center = box.center();
  if (!(length(center) > static_cast<double>(far_away * box.radius()))) return std::nullopt;
  return scene.world_origin + center;
}

}  // namespace tyndall::loader
