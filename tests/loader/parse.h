// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tyndall/loader/load_scene.h"

namespace tyndall::test {

/// A scene with a camera, a light and `world` after WorldBegin; `options` stand before it.
inline LoadedScene parse_world(const std::string& world, const std::string& options = "") {
  return parse_scene(
      options + "\nCamera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n" + world,
      "test.pbrt");
}

/// A scene with nothing but `options`, a camera and a light.
inline LoadedScene parse_options(const std::string& options) {
  return parse_world("", options);
}

/// What loading throws, or an empty string.
inline std::string error_of(const std::string& text, const LoadOptions& options = {}) {
  try {
    parse_scene(text, "test.pbrt", options);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

/// The only surface of a scene with that world.
inline Surface surface_of(const std::string& world) {
  return parse_world(world).scene.surfaces.at(0);
}

}  // namespace tyndall::test
