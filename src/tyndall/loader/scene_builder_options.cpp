// SPDX-License-Identifier: Apache-2.0
// Directives that stand before WorldBegin.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/numbers.h"
#include "tyndall/loader/scene_builder.h"

namespace tyndall::loader {
namespace {

// pbrt-v4 takes "disable-pixel-jitter", "disable_pixel_jitter" and "disablePixelJitter"
// alike.
std::string normalized(std::string_view name) {
  std::string result;
  for (const char c : name)
    if (c != '-' && c != '_')
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

const std::vector<std::string_view> option_names{"disablepixeljitter",
                                                 "disabletexturefiltering",
                                                 "disablewavelengthjitter",
                                                 "displacementedgescale",
                                                 "msereferenceimage",
                                                 "msereferenceout",
                                                 "rendercoordsys",
                                                 "seed",
                                                 "forcediffuse",
                                                 "pixelstats",
                                                 "wavefront"};

}  // namespace

void SceneBuilder::camera(const std::string& type, ParameterSet parameters) {
  camera_ = make_camera(type, parameters, state_.ctm);
  camera_media_ = state_.media;
  coordinate_systems_["camera"] = state_.ctm.inverse();
  parameters.report_unknown();
}

void SceneBuilder::film(const std::string& type, ParameterSet parameters) {
  set_film(type, parameters, settings_);
  parameters.report_unknown();
}

void SceneBuilder::pixel_filter(const std::string& type, ParameterSet parameters) {
  set_pixel_filter(type, parameters, settings_);
  parameters.report_unknown();
}

void SceneBuilder::sampler(const std::string& type, ParameterSet parameters) {
  set_sampler(type, parameters, settings_);
  parameters.report_unknown();
}

void SceneBuilder::integrator(const std::string& type, ParameterSet parameters) {
  set_integrator(type, parameters, settings_);
  parameters.report_unknown();
}

void SceneBuilder::accelerator(const std::string& type, ParameterSet parameters) {
  // Embree does it in any case; the choice cannot change the picture.
  if (type != "bvh" && type != "kdtree")
    fail(directive_,
         fmt::format("there is no accelerator \"{}\"; there are \"bvh\" and \"kdtree\"",
                     type));
  parameters.ignore_all();
}

void SceneBuilder::option(const std::string& name, const std::string& value) {
  const std::string key = normalized(name);
  if (std::find(option_names.begin(), option_names.end(), key) == option_names.end())
    fail(directive_,
         fmt::format("there is no option \"{}\"{}", name, did_you_mean(key, option_names)));
  if (key == "rendercoordsys") {
    if (value != "camera" && value != "cameraworld" && value != "world")
      fail(directive_, fmt::format("Option \"rendercoordsys\" must be \"cameraworld\", "
                                   "\"camera\" or \"world\", got \"{}\"",
                                   value));
    coordinates_ = value;
    return;
  }
  if (key != "seed") {
    reporter_.unsupported(directive_, fmt::format("Option \"{}\" is ignored", name));
    return;
  }
  int seed = 0;
  if (parse_number(value, seed) != NumberError::none)
    fail(directive_, fmt::format("Option \"seed\" must be an integer, got \"{}\"", value));
  settings_.seed = static_cast<uint64_t>(static_cast<uint32_t>(seed));
}

// Floats are finest about the camera. "camera" turns the axes as well in pbrt-v4, which
// makes no number finer.
Vec3d SceneBuilder::chosen_origin() const {
  if (wanted_origin_) return *wanted_origin_;
  if (!camera_ || coordinates_ == "world") return {};
  const Vec3d eye = camera_->settings.world_from_camera.precise_point({});
  return std::isfinite(length(eye)) ? eye : Vec3d{};
}

// Only the camera and media can have been made already.
void SceneBuilder::put_origin_at(Vec3d p) {
  origin_ = p;
  if (camera_) {
    Transform& world_from_camera = camera_->settings.world_from_camera;
    world_from_camera = Transform::translate(-p) * world_from_camera;
  }
  for (Medium& medium : media_) medium.move(-p);
}

void SceneBuilder::world_begin() {
  is_in_world_ = true;
  world_begin_ = directive_;
  put_origin_at(chosen_origin());
  state_.ctm = Transform();
  state_.moves_start = true;
  coordinate_systems_["world"] = Transform();
}

void SceneBuilder::world_end() {
  reporter_.warning(directive_, "WorldEnd is not part of pbrt-v4; it is ignored");
}

}  // namespace tyndall::loader
