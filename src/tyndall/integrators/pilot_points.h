// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tyndall/scene/scene.h"

namespace tyndall {

/// Points in media that camera paths come by: where light matters for the picture. Found by
/// a few thousand short walks, the same at every call; empty if they meet no medium.
std::vector<Vec3> pilot_points(const Scene& scene);

}  // namespace tyndall
