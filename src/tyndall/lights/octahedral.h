// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/vec.h"

namespace tyndall {

/// The equal-area octahedral map between the unit square and the sphere [Clarberg08], in
/// the orientation of pbrt-v4: the upper hemisphere (z >= 0) is the diamond |x| + |y| <= 1
/// of (x, y) = 2 p - 1, the lower one fills the four corners. A part of the square covers 4
/// pi times its area in solid angle.

/// The unit direction of a point `p` in [0, 1]^2.
Vec3 octahedral_direction(Vec2 p);
/// The inverse, for a unit direction; always within [0, 1]^2.
Vec2 octahedral_position(Vec3 w);

}  // namespace tyndall
