// SPDX-License-Identifier: Apache-2.0
// Transformations, scopes, and the state between directives.
#include "tyndall/loader/scene_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tyndall/integrators/nearest_name.h"

namespace tyndall::loader {
namespace {

constexpr std::array<std::string_view, 5> attribute_targets{"shape", "light", "material",
                                                            "medium", "texture"};

// Which Attribute defaults a directive takes; empty if none.
std::string_view attribute_target(std::string_view directive) {
  if (directive == "Shape") return "shape";
  if (directive == "LightSource" || directive == "AreaLightSource") return "light";
  if (directive == "Material" || directive == "MakeNamedMaterial") return "material";
  if (directive == "MakeNamedMedium") return "medium";
  if (directive == "Texture") return "texture";
  return {};
}

}  // namespace

void SceneBuilder::enter(Phase phase, const Token& directive) {
  directive_ = directive.where;
  if (phase == Phase::before_world && is_in_world_)
    fail(directive.where,
         directive.text == "WorldBegin"
             ? "WorldBegin stands twice"
             : fmt::format("{} must stand before WorldBegin", directive.text));
  if (phase == Phase::in_world && !is_in_world_ && !is_world_missed_) {
    is_world_missed_ = true;  // said once, not for each shape
    reporter_.error(directive.where,
                    fmt::format("{} must stand after WorldBegin", directive.text));
  }
}

ParameterSet SceneBuilder::parameter_set(const Token& directive, const std::string& name,
                                         std::vector<Parameter> parameters) {
  const auto defaults = state_.defaults.find(attribute_target(directive.text));
  return {fmt::format("{} \"{}\"", directive.text, name), directive.where, reporter_,
          std::move(parameters),
          defaults == state_.defaults.end() ? nullptr : &defaults->second};
}

void SceneBuilder::check_transform(const Transform& transform, Span where) const {
  if (!transform.fits_in_floats())
    fail(where, "the transformation has become too large or too small for numbers");
}

Transform SceneBuilder::from_here(Vec3d origin) const {
  const Transform transform = Transform::translate(-origin) * state_.ctm;
  check_transform(transform, directive_);
  return transform;
}

void SceneBuilder::identity() {
  if (state_.moves_start) state_.ctm = Transform();
}

void SceneBuilder::concatenate(const Transform& transform) {
  set_transform(state_.ctm * transform);
}

void SceneBuilder::set_transform(const Transform& transform) {
  if (!state_.moves_start) return;
  check_transform(transform, directive_);
  state_.ctm = transform;
}

void SceneBuilder::coordinate_system(const std::string& name) {
  coordinate_systems_[name] = state_.ctm;
}

void SceneBuilder::coordinate_system_transform(const std::string& name) {
  const auto found = coordinate_systems_.find(name);
  if (found == coordinate_systems_.end())
    fail(directive_, fmt::format("there is no coordinate system named \"{}\"{}", name,
                                 did_you_mean(name, keys_of(coordinate_systems_))));
  if (state_.moves_start) state_.ctm = found->second;
}

void SceneBuilder::active_transform(const std::string& which) {
  if (which != "StartTime" && which != "EndTime" && which != "All")
    fail(directive_,
         fmt::format("ActiveTransform must be StartTime, EndTime or All, got \"{}\"",
                     which));
  if (which == "EndTime")
    reporter_.unsupported(
        directive_,
        "ActiveTransform: motion is not supported yet; everything stands still");
  state_.moves_start = which != "EndTime";
}

void SceneBuilder::transform_times() {
  reporter_.unsupported(
      directive_, "TransformTimes: motion is not supported yet; everything stands still");
}

void SceneBuilder::reverse_orientation() {
  state_.reverse_orientation = !state_.reverse_orientation;
}

void SceneBuilder::save(Scope scope) { saved_.push_back({scope, state_, directive_}); }

void SceneBuilder::restore(Scope scope, std::string_view begin) {
  if (saved_.empty() || saved_.back().scope != scope)
    fail(directive_, fmt::format("there is no {} to end here", begin));
  const Transform ctm = saved_.back().state.ctm;
  if (scope == Scope::transform)
    state_.ctm = ctm;
  else
    state_ = std::move(saved_.back().state);
  saved_.pop_back();
}

void SceneBuilder::attribute_begin() { save(Scope::attribute); }
void SceneBuilder::attribute_end() { restore(Scope::attribute, "AttributeBegin"); }
void SceneBuilder::transform_begin() { save(Scope::transform); }
void SceneBuilder::transform_end() { restore(Scope::transform, "TransformBegin"); }
void SceneBuilder::begin_import() { save(Scope::import); }

void SceneBuilder::end_import() {
  while (!saved_.empty() && saved_.back().scope != Scope::import) {
    reporter_.error(saved_.back().where, "this scope is not ended in its file");
    if (saved_.back().scope == Scope::object) is_in_object_ = false;
    saved_.pop_back();
  }
  restore(Scope::import, "Import");
}

void SceneBuilder::object_begin(const std::string& name) {
  if (is_in_object_) fail(directive_, "an object cannot be defined within an object");
  if (!objects_by_name_.emplace(name, objects_.size()).second)
    reporter_.error(directive_,
                    fmt::format("there is already an object named \"{}\"", name));
  save(Scope::object);
  is_in_object_ = true;
  objects_.push_back({state_.ctm.precise_point({}), {}});
}

void SceneBuilder::object_end() {
  restore(Scope::object, "ObjectBegin");
  is_in_object_ = false;
}

void SceneBuilder::attribute(const std::string& target, std::vector<Parameter> parameters) {
  const std::vector<std::string_view> targets(attribute_targets.begin(),
                                              attribute_targets.end());
  if (std::find(targets.begin(), targets.end(), target) == targets.end())
    fail(directive_, fmt::format("Attribute must be for one of {}, got \"{}\"",
                                 quoted_list(targets), target));
  std::vector<Parameter>& defaults = state_.defaults[target];
  for (Parameter& parameter : parameters) {
    parameter.is_default = true;
    defaults.insert(defaults.begin(), std::move(parameter));  // the latest counts
  }
}

void SceneBuilder::set_color_space(const std::string& name) {
  const auto space = color_space_by_name(name);
  if (!space)
    fail(directive_, fmt::format("there is no color space \"{}\"; there are \"srgb\", "
                                 "\"rec2020\", \"aces2065-1\" "
                                 "and "
                                 "\"dci-p3\"",
                                 name));
  state_.color_space = *space;
}

}  // namespace tyndall::loader
