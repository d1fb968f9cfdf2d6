// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tyndall/loader/load_scene.h"

namespace tyndall::app {

/// What a scene consists of, for people: several lines, each with its end.
std::string scene_text(const std::string& path, const LoadedScene& loaded);

/// The same for programs.
nlohmann::ordered_json scene_json(const std::string& path, const LoadedScene& loaded);

}  // namespace tyndall::app
