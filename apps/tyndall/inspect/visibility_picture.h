// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/guiding/visibility_map.h"
#include "tyndall/image/image.h"

namespace tyndall::app {

/// What a light sees: the distance to the first surface in false color, white where there
/// is none, black where the light does not shine. With frame and legend.
Image visibility_picture(const VisibilityMap& map, size_t light);

}  // namespace tyndall::app
