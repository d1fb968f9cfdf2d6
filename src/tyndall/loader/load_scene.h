// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tyndall/integrators/render_settings.h"
#include "tyndall/loader/diagnostics.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall {

struct LoadOptions {
  bool strict = false;     ///< what is not supported is an error, not a warning
  WarningSink on_warning;  ///< may be empty
  /// Coordinates stay the file's: no world_origin, whatever "rendercoordsys" says.
  bool keeps_world = false;
};

struct LoadedScene {
  SceneDescription scene;
  RenderSettings settings;
  std::vector<Diagnostic> warnings;  ///< the same that on_warning was called with
};

/// Reads a pbrt-v4 scene file with all files that it names. Throws SceneError for whatever
/// is wrong in them, std::runtime_error if the file itself cannot be read.
LoadedScene load_scene(const std::string& path, const LoadOptions& options = {});

/// The same for text in memory; `name` stands for the file, its folder resolves relative
/// paths.
LoadedScene parse_scene(std::string_view text, const std::string& name,
                        const LoadOptions& options = {});

}  // namespace tyndall
