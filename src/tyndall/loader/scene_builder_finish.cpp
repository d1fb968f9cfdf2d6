// SPDX-License-Identifier: Apache-2.0
// From the directives to the scene: names are looked up, omissions found.
#include <fmt/format.h>

#include <algorithm>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/scene_builder.h"

namespace tyndall::loader {

// A name that does not exist is reported once, where it is brought in, not for each shape.
bool SceneBuilder::is_first_report(Span where) {
  return reported_.emplace(where.source, where.begin).second;
}

int SceneBuilder::medium_index(const std::string& name, Span where) {
  if (name.empty()) return no_medium;
  const auto found = media_by_name_.find(name);
  if (found != media_by_name_.end()) return found->second;
  if (is_first_report(where))
    reporter_.error(where, fmt::format("there is no medium named \"{}\"{}", name,
                                       did_you_mean(name, keys_of(media_by_name_))));
  return no_medium;
}

Material SceneBuilder::resolved(const MaterialReference& reference) {
  if (reference.name.empty()) return reference.material;
  const auto found = materials_.find(reference.name);
  if (found != materials_.end()) return found->second;
  if (is_first_report(reference.where))
    reporter_.error(reference.where,
                    fmt::format("there is no material named \"{}\"{}", reference.name,
                                did_you_mean(reference.name, keys_of(materials_))));
  return reference.material;
}

Surface SceneBuilder::resolved(PendingSurface pending) {
  Surface surface = std::move(pending.surface);
  surface.material = resolved(pending.material);
  surface.media = {medium_index(pending.media.inside, pending.media.where),
                   medium_index(pending.media.outside, pending.media.where),
                   pending.media.is_stated};
  return surface;
}

std::vector<Surface> SceneBuilder::resolved(std::vector<PendingSurface> pending) {
  std::vector<Surface> surfaces;
  surfaces.reserve(pending.size());
  for (PendingSurface& surface : pending) surfaces.push_back(resolved(std::move(surface)));
  return surfaces;
}

std::vector<ObjectInstance> SceneBuilder::resolved_instances() {
  std::vector<ObjectInstance> instances;
  for (const PendingInstance& instance : instances_) {
    const auto found = objects_by_name_.find(instance.object);
    if (found != objects_by_name_.end())
      instances.push_back({found->second, instance.world_from_object});
    else
      reporter_.error(
          instance.where,
          fmt::format("there is no object named \"{}\"{}", instance.object,
                      did_you_mean(instance.object, keys_of(objects_by_name_))));
  }
  return instances;
}

void SceneBuilder::check_complete(Span end) {
  for (const Saved& saved : saved_)
    reporter_.error(saved.where, "this scope is never ended");
  if (!is_in_world_ && !is_world_missed_)
    reporter_.error(end, "the scene has no WorldBegin");
}

void SceneBuilder::check_lights(const SceneDescription& scene, Span end) {
  const bool has_light =
      !scene.lights.empty() ||
      std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                  [](const Surface& s) { return s.emission.has_value(); }) ||
      std::any_of(scene.media.begin(), scene.media.end(),
                  [](const Medium& m) { return m.is_emissive(); });
  if (!has_light)
    reporter_.error(end, "the scene has no lights: the picture would be black");
}

LoadedScene SceneBuilder::finish(Span end) {
  check_complete(end);
  LoadedScene loaded;
  SceneDescription& scene = loaded.scene;
  scene.camera_medium = medium_index(camera_media_.outside, camera_media_.where);
  scene.surfaces = resolved(std::move(surfaces_));
  for (std::vector<PendingSurface>& object : objects_)
    scene.objects.push_back(resolved(std::move(object)));
  scene.instances = resolved_instances();
  scene.media = std::move(media_);
  scene.lights = std::move(lights_);
  reporter_.throw_if_errors();
  if (!camera_) reporter_.error(world_begin_, "the scene has no Camera before WorldBegin");
  check_lights(scene, end);
  reporter_.throw_if_errors();
  scene.camera =
      PerspectiveCamera(fit_to_film(*camera_, settings_.resolution), settings_.resolution);
  loaded.settings = settings_;
  loaded.settings.imaging_ratio *= camera_->exposure_time;
  loaded.warnings = reporter_.take_warnings();
  return loaded;
}

}  // namespace tyndall::loader
