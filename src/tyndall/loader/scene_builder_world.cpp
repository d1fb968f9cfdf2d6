// SPDX-License-Identifier: Apache-2.0
// Directives that describe the world.
#include <fmt/format.h>

#include <algorithm>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/area_light_power.h"
#include "tyndall/loader/scene_builder.h"

namespace tyndall::loader {

void SceneBuilder::make_named_medium(const std::string& name, ParameterSet parameters) {
  if (!media_by_name_.emplace(name, no_medium).second)
    fail(directive_, fmt::format("there is already a medium named \"{}\"", name));
  std::optional<Medium> medium = make_medium(parameters, from_here(origin_), files_);
  parameters.report_unknown();
  if (!medium) return;
  media_by_name_[name] = static_cast<int>(media_.size());
  media_.push_back(std::move(*medium));
}

void SceneBuilder::medium_interface(const std::string& inside, const std::string& outside) {
  state_.media = {inside, outside, true, directive_};
}

void SceneBuilder::make_named_material(const std::string& name, ParameterSet parameters) {
  if (!materials_.emplace(name, DiffuseBsdf{Rgb(0.5f)}).second)
    fail(directive_, fmt::format("there is already a material named \"{}\"", name));
  const std::string type = parameters.required_string("type");
  materials_[name] = make_material(type, parameters, textures_, materials_);
  parameters.report_unknown();
}

void SceneBuilder::note_broken(bool is_medium, const std::string& name) {
  if (is_medium)
    media_by_name_.emplace(name, no_medium);
  else
    materials_.emplace(name, DiffuseBsdf{Rgb(0.5f)});
}

void SceneBuilder::named_material(const std::string& name) {
  state_.material = {DiffuseBsdf{Rgb(0.5f)}, name, directive_};
}

void SceneBuilder::material(const std::string& type, ParameterSet parameters) {
  state_.material = {make_material(type, parameters, textures_, materials_), "",
                     directive_};
  parameters.report_unknown();
}

void SceneBuilder::texture(const std::string& name, const std::string& kind,
                           const std::string& type, ParameterSet parameters) {
  textures_.make(name, kind, type, parameters);
  parameters.report_unknown();
}

void SceneBuilder::light_source(const std::string& type, ParameterSet parameters) {
  std::optional<Light> light = make_light(type, parameters, from_here(origin_), files_);
  parameters.report_unknown();
  if (light) lights_.push_back(std::move(*light));
}

void SceneBuilder::area_light_source(const std::string& type, ParameterSet parameters) {
  state_.area_light = make_area_light(type, parameters, files_);
  parameters.report_unknown();
}

std::vector<SceneBuilder::PendingSurface>& SceneBuilder::target_surfaces() {
  return is_in_object_ ? objects_.back().surfaces : surfaces_;
}

void SceneBuilder::shape(const std::string& type, ParameterSet parameters) {
  std::optional<Shape> shape = make_shape(
      type, parameters, from_here(is_in_object_ ? objects_.back().origin : origin_),
      state_.reverse_orientation, files_);
  // As in pbrt-v4, no ray meets what has no alpha, but its light still shines.
  const float alpha = textures_.number(parameters, "alpha", 1, {0, 1});
  parameters.report_unknown();
  if (!shape) return;
  if (alpha == 0)
    add_hidden_emitter(std::move(*shape));
  else
    add_surface(type, std::move(*shape), alpha, parameters);
}

void SceneBuilder::add_hidden_emitter(Shape shape) {
  if (is_in_object_ || !state_.area_light) return;
  for (auto& [part, emission] : with_emission(std::move(shape), state_.area_light))
    hidden_emitters_.push_back({std::move(part), emission.value()});
}

void SceneBuilder::add_surface(const std::string& type, Shape shape, float alpha,
                               ParameterSet& parameters) {
  const SourceLocation at = reporter_.sources().locate(directive_);
  const std::string name = fmt::format("{} at {}:{}:{}", type, at.file, at.line, at.column);
  if (state_.area_light && is_in_object_)
    parameters.reporter().unsupported(
        directive_,
        fmt::format("{}: an area light in an object is not supported; it does not shine",
                    parameters.owner()));
  for (auto& [part, emission] :
       with_emission(std::move(shape), is_in_object_ ? std::nullopt : state_.area_light)) {
    target_surfaces().push_back(
        {{std::move(part), DiffuseBsdf{}, {}, emission, name, alpha},
         state_.material,
         state_.media});
  }
}

void SceneBuilder::object_instance(const std::string& name) {
  if (is_in_object_) fail(directive_, "an object cannot be placed within an object");
  instances_.push_back({name, state_.ctm, directive_});
}

}  // namespace tyndall::loader
