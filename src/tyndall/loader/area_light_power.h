// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/loader/graphics_state.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall::loader {

/// A shape, or a part of one, and what it emits.
struct EmissivePart {
  Shape shape;
  std::optional<AreaEmission> emission;
};

/// The shape with the emission that `light` asks for. "power" holds for each triangle or
/// patch by itself, as in pbrt-v4; a mesh whose pieces differ in area is cut into them.
std::vector<EmissivePart> with_emission(Shape shape,
                                        const std::optional<AreaLightRequest>& light);

}  // namespace tyndall::loader
