// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tyndall/guiding/guiding_file.h"
#include "tyndall/integrators/connection_leg.h"

namespace tyndall::app {

/// The connections of a render that has learned what is in the file, or nothing.
inline ConnectionSettings known_guiding(const GuidingFile* file) {
  ConnectionSettings settings{.single = true, .dual = true, .min_distance_ratio = 1};
  if (!file) return settings;
  settings.visibility = true;
  settings.known_visibility = std::make_shared<const LightVisibility>(file->maps);
  if (!file->records) return settings;
  settings.direction = true;
  settings.known_directions = std::make_shared<const RecordCache>(*file->records);
  return settings;
}

}  // namespace tyndall::app
