// SPDX-License-Identifier: Apache-2.0
// From the directives to the scene: names are looked up, omissions found.
#include <fmt/format.h>

#include <algorithm>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/scene_builder.h"

namespace tyndall::loader {

// A name that does not exist is reported once, where it is brought in, not for each shape.
template <typename Map>
void SceneBuilder::miss(std::string_view kind, const std::string& name, const Map& known,
                        Span where) {
  const auto [entry, is_new] =
      missing_.try_emplace({where.source, where.begin}, Failure{where, {}});
  if (is_new)
    entry->second.message = fmt::format("there is no {} named \"{}\"{}", kind, name,
                                        did_you_mean(name, keys_of(known)));
}

// Names are looked up by kind; a reader goes from top to bottom.
void SceneBuilder::report_missing() {
  std::vector<Failure> failures;
  for (auto& [place, failure] : missing_) failures.push_back(std::move(failure));
  std::sort(failures.begin(), failures.end(), [this](const Failure& a, const Failure& b) {
    return reporter_.sources().is_before(a.where, b.where);
  });
  for (Failure& failure : failures) reporter_.error(failure.where, failure.message);
}

int SceneBuilder::medium_index(const std::string& name, Span where) {
  if (name.empty()) return no_medium;
  const auto found = media_by_name_.find(name);
  if (found != media_by_name_.end()) return found->second;
  miss("medium", name, media_by_name_, where);
  return no_medium;
}

Material SceneBuilder::resolved(const MaterialReference& reference) {
  if (reference.name.empty()) return reference.material;
  const auto found = materials_.find(reference.name);
  if (found != materials_.end()) return found->second;
  miss("material", reference.name, materials_, reference.where);
  return reference.material;
}

Surface SceneBuilder::resolved(PendingSurface pending) {
  Surface surface = std::move(pending.surface);
  surface.material = resolved(pending.material);
  if (surface.alpha < 1 && std::holds_alternative<InterfaceBsdf>(surface.material))
    reporter_.unsupported(pending.material.where,
                          "alpha on the boundary of a medium is not supported");
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

Transform SceneBuilder::placed(const PendingInstance& instance,
                               const PendingObject& object) {
  const Transform scene_from_object =
      Transform::translate(-origin_) * instance.ctm * Transform::translate(object.origin);
  try {
    check_transform(scene_from_object, instance.where);
  } catch (const Failure& failure) {
    reporter_.error(failure.where, failure.message);
  }
  return scene_from_object;
}

std::vector<ObjectInstance> SceneBuilder::resolved_instances() {
  std::vector<ObjectInstance> instances;
  for (const PendingInstance& instance : instances_) {
    const auto found = objects_by_name_.find(instance.object);
    if (found != objects_by_name_.end())
      instances.push_back({found->second, placed(instance, objects_[found->second])});
    else
      miss("object", instance.object, objects_by_name_, instance.where);
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
      !scene.lights.empty() || !scene.hidden_emitters.empty() ||
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
  scene.world_origin = origin_;
  scene.camera_medium = medium_index(camera_media_.outside, camera_media_.where);
  scene.surfaces = resolved(std::move(surfaces_));
  for (PendingObject& object : objects_)
    scene.objects.push_back(resolved(std::move(object.surfaces)));
  scene.instances = resolved_instances();
  scene.media = std::move(media_);
  scene.lights = std::move(lights_);
  scene.hidden_emitters = std::move(hidden_emitters_);
  report_missing();
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
