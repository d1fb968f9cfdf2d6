// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/make_scene_parts.h"

namespace tyndall::loader {
namespace {

constexpr Range proper_angle{0, 180, true};

void read_screen_window(ParameterSet& parameters, CameraRequest& camera) {
  const std::vector<float> window = parameters.numbers("screenwindow");
  if (!parameters.has("screenwindow")) return;
  if (window.size() != 4) {
    parameters.error(
        "screenwindow",
        fmt::format("parameter \"screenwindow\" takes 4 values, got {}", window.size()));
    return;
  }
  if (!(window[0] < window[1] && window[2] < window[3])) {
    parameters.error(
        "screenwindow",
        fmt::format(
            "parameter \"screenwindow\" takes x_min x_max y_min y_max, each min below "
            "max; got {} {} {} {}",
            window[0], window[1], window[2], window[3]));
    return;
  }
  camera.has_screen_window = true;
  camera.settings.screen_min_x = window[0];
  camera.settings.screen_max_x = window[1];
  camera.settings.screen_min_y = window[2];
  camera.settings.screen_max_y = window[3];
}

float read_exposure_time(ParameterSet& parameters) {
  const float open = parameters.number("shutteropen", 0);
  const float close = parameters.number("shutterclose", 1);
  if (close > open) return close - open;
  parameters.error(
      parameters.has("shutterclose") ? "shutterclose" : "shutteropen",
      fmt::format("the shutter must close after it opens; it opens at {}, closes at {}",
                  open, close));
  return 1;
}

float read_fov(ParameterSet& parameters) {
  const float fov = parameters.number("fov", 90, proper_angle);
  const float half = parameters.number("halffov", 0, {0, 90, true});
  return half > 0 ? 2 * half : fov;
}

}  // namespace

CameraRequest make_camera(const std::string& type, ParameterSet& parameters,
                          const Transform& camera_from_world) {
  if (type == "orthographic" || type == "spherical" || type == "realistic")
    fail(parameters.where(),
         fmt::format("{}: this camera is not supported; there is \"perspective\"",
                     parameters.owner()));
  if (type != "perspective") parameters.fail_unknown_type("camera", type, {"perspective"});
  CameraRequest camera;
  camera.settings.world_from_camera = camera_from_world.inverse();
  camera.settings.fov = read_fov(parameters);
  camera.settings.lens_radius = parameters.number("lensradius", 0, not_negative);
  camera.settings.focal_distance = parameters.number("focaldistance", 1e6f, positive);
  if (parameters.has("frameaspectratio"))
    camera.aspect_ratio = parameters.number("frameaspectratio", 1, positive);
  read_screen_window(parameters, camera);
  camera.exposure_time = read_exposure_time(parameters);
  return camera;
}

PerspectiveCamera::Settings fit_to_film(const CameraRequest& camera, Vec2i resolution) {
  PerspectiveCamera::Settings settings = camera.settings;
  if (camera.has_screen_window) return settings;
  const float aspect = camera.aspect_ratio.value_or(static_cast<float>(resolution.x) /
                                                    static_cast<float>(resolution.y));
  settings.screen_max_x = std::max(aspect, 1.0f);
  settings.screen_max_y = std::max(1 / aspect, 1.0f);
  settings.screen_min_x = -settings.screen_max_x;
  settings.screen_min_y = -settings.screen_max_y;
  return settings;
}

}  // namespace tyndall::loader
