// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/scene/scene_description.h"

namespace tyndall::loader {

/// Where in the world the origin would be better than where it is: at the center of the
/// shapes, if they are so far from it that their floats are coarse for their size. Empty
/// otherwise.
std::optional<Vec3d> better_origin(const SceneDescription& scene);

}  // namespace tyndall::loader
