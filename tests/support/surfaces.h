// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/scene/scene_description.h"

namespace tyndall::test {

/// A full sphere that is only the boundary between media.
Surface sphere_boundary(Vec3 center, float radius, int inside, int outside);
/// A box of twelve triangles that is only the boundary between media.
Surface box_boundary(Vec3 min, Vec3 max, int inside, int outside);
/// A camera at `eye` that looks along z.
PerspectiveCamera camera_at(Vec3 eye);

}  // namespace tyndall::test
