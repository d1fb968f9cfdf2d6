// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "tyndall/loader/make_scene_parts.h"

namespace tyndall::loader {
namespace {

constexpr int64_t max_pixels = int64_t{1} << 28;
constexpr Range at_least_one_pixel{1, infinity};

void read_resolution(ParameterSet& parameters, RenderSettings& settings) {
  settings.resolution.x = parameters.integer("xresolution", 1280, at_least_one_pixel);
  settings.resolution.y = parameters.integer("yresolution", 720, at_least_one_pixel);
  const auto [x, y] = settings.resolution;
  if (int64_t{x} * int64_t{y} > max_pixels) {
    parameters.error("xresolution",
                     fmt::format("a film of {} x {} pixels is too large; at most {} fit", x,
                                 y, max_pixels));
    settings.resolution = {1, 1};
  }
}

// [x_min x_max y_min y_max] of the whole film, max exclusive.
bool set_crop(ParameterSet& parameters, std::string_view name,
              const std::array<int, 4>& bounds, RenderSettings& settings) {
  const Vec2i size = settings.resolution;
  settings.crop_min = {std::clamp(bounds[0], 0, size.x), std::clamp(bounds[2], 0, size.y)};
  settings.crop_max = {std::clamp(bounds[1], 0, size.x), std::clamp(bounds[3], 0, size.y)};
  if (settings.crop_min.x < settings.crop_max.x &&
      settings.crop_min.y < settings.crop_max.y)
    return true;
  parameters.error(
      name, fmt::format("parameter \"{}\" leaves no pixels of the {} x {} film", name,
                        size.x, size.y));
  return false;
}

void read_crop_window(ParameterSet& parameters, RenderSettings& settings) {
  const std::vector<float> window = parameters.numbers("cropwindow");
  if (!parameters.has("cropwindow")) return;
  if (window.size() != 4) {
    parameters.error(
        "cropwindow",
        fmt::format("parameter \"cropwindow\" takes 4 values, got {}", window.size()));
    return;
  }
  const auto pixel = [](float fraction, int size) {
    return static_cast<int>(
        std::ceil(static_cast<float>(size) * std::clamp(fraction, 0.0f, 1.0f)));
  };
  const auto [x, y] = settings.resolution;
  set_crop(
      parameters, "cropwindow",
      {pixel(std::min(window[0], window[1]), x), pixel(std::max(window[0], window[1]), x),
       pixel(std::min(window[2], window[3]), y), pixel(std::max(window[2], window[3]), y)},
      settings);
}

void read_pixel_bounds(ParameterSet& parameters, RenderSettings& settings) {
  const std::vector<int> bounds = parameters.integers("pixelbounds");
  if (!parameters.has("pixelbounds")) return;
  if (bounds.size() != 4) {
    parameters.error(
        "pixelbounds",
        fmt::format("parameter \"pixelbounds\" takes 4 values, got {}", bounds.size()));
    return;
  }
  set_crop(parameters, "pixelbounds", {bounds[0], bounds[1], bounds[2], bounds[3]},
           settings);
}

void read_sensor(ParameterSet& parameters, RenderSettings& settings) {
  const std::string sensor = parameters.string("sensor", "cie1931");
  if (sensor != "cie1931")
    parameters.unsupported(
        "sensor",
        fmt::format("sensor \"{}\" is not supported, \"cie1931\" is used instead", sensor));
  const float white_balance = parameters.number("whitebalance", 0, not_negative);
  if (white_balance != 0)
    parameters.unsupported("whitebalance",
                           "white balance is not supported yet, it is ignored");
  settings.imaging_ratio = parameters.number("iso", 100, positive) / 100;
}

}  // namespace

void set_film(const std::string& type, ParameterSet& parameters, RenderSettings& settings) {
  if (type != "rgb" && type != "gbuffer" && type != "spectral")
    parameters.fail_unknown_type("film", type, {"rgb", "gbuffer", "spectral"});
  if (type != "rgb")
    parameters.reporter().unsupported(
        parameters.where(),
        fmt::format("{}: not supported, \"rgb\" is used instead", parameters.owner()));
  read_resolution(parameters, settings);
  settings.crop_min = {0, 0};
  settings.crop_max = settings.resolution;
  read_crop_window(parameters, settings);
  read_pixel_bounds(parameters, settings);
  settings.output = parameters.string("filename", settings.output);
  read_sensor(parameters, settings);
  settings.max_component = parameters.number("maxcomponentvalue", infinity, positive);
  parameters.ignore(
      {"diagonal", "savefp16", "coordinatesystem", "nbuckets", "lambdamin", "lambdamax"});
}

}  // namespace tyndall::loader
