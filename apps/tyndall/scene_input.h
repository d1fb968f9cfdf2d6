// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tyndall/loader/load_scene.h"

namespace tyndall::app {

/// A scene file on its way in. Warnings go to stderr, each once.
class SceneInput {
 public:
  SceneInput(std::string path, bool strict, bool quiet);

  /// Throws what load_scene() throws. `keeps_world` as in LoadOptions.
  LoadedScene load(bool keeps_world = false);
  /// Prints sentences that concern the scene as a whole.
  void warn_all(const std::vector<std::string>& sentences);
  int warning_count() const { return static_cast<int>(printed_.size()); }

 private:
  void warn(const std::string& text);

  std::string path_;
  bool strict_, quiet_;
  std::set<std::string> printed_;
};

/// The camera for another size of picture. A screen window that pbrt would have chosen for
/// the old size becomes the one that it would choose for the new; any other stays.
PerspectiveCamera resized(const PerspectiveCamera& camera, Vec2i old_size, Vec2i new_size);

}  // namespace tyndall::app
