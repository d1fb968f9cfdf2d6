// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "tyndall/math/vec.h"

namespace tyndall {

/// The factor by which a map from the unit square to a surface in space stretches area at
/// u, by central differences of the step 1/512. A density must be its inverse. Relative
/// error about 1e-3 for smooth maps; keep u away from edges and kinks.
double surface_jacobian(const std::function<Vec3(Vec2)>& map, Vec2 u);
/// The same for a map from the unit interval to the line.
double line_jacobian(const std::function<float(float)>& map, float u);

}  // namespace tyndall
