// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/scene_input.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace tyndall::app {

namespace {

/// pbrt's choice of screen window: the shorter side spans [-1, 1].
PerspectiveCamera::Settings with_default_window(PerspectiveCamera::Settings settings,
                                                Vec2i size) {
  const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
  const float x = aspect > 1 ? aspect : 1, y = aspect > 1 ? 1 : 1 / aspect;
  settings.screen_min_x = -x;
  settings.screen_max_x = x;
  settings.screen_min_y = -y;
  settings.screen_max_y = y;
  return settings;
}

bool is_near(float a, float b) { return std::abs(a - b) <= 1e-5f * std::abs(a); }

bool has_same_window(const PerspectiveCamera::Settings& a,
                     const PerspectiveCamera::Settings& b) {
  return is_near(a.screen_min_x, b.screen_min_x) &&
         is_near(a.screen_max_x, b.screen_max_x) &&
         is_near(a.screen_min_y, b.screen_min_y) && is_near(a.screen_max_y, b.screen_max_y);
}

}  // namespace

SceneInput::SceneInput(std::string path, bool strict, bool quiet)
    : path_(std::move(path)), strict_(strict), quiet_(quiet) {}

LoadedScene SceneInput::load(bool keeps_world) {
  LoadOptions options;
  options.strict = strict_;
  options.keeps_world = keeps_world;
  options.on_warning = [this](const Diagnostic& diagnostic) { warn(diagnostic.text); };
  return load_scene(path_, options);
}

void SceneInput::warn_all(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences)
    warn(fmt::format("{}: warning: {}", path_, sentence));
}

void SceneInput::warn(const std::string& text) {
  if (printed_.insert(text).second && !quiet_) fmt::print(stderr, "{}\n", text);
}

PerspectiveCamera resized(const PerspectiveCamera& camera, Vec2i old_size, Vec2i new_size) {
  const PerspectiveCamera::Settings& settings = camera.settings();
  const bool was_default =
      has_same_window(settings, with_default_window(settings, old_size));
  return {was_default ? with_default_window(settings, new_size) : settings, new_size};
}

}  // namespace tyndall::app
