// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/brick_grid.h"

namespace tyndall {

/// Where a grid lies in medium space.
struct GridPlace {
  Transform medium_from_grid;  ///< from sample coordinates
  Bounds3 box;  ///< in sample coordinates; zero outside; empty if the grid is
};

/// A grid and its place. Cheap to copy: the samples are shared.
struct PlacedGrid : GridPlace {
  std::shared_ptr<const BrickGrid> grid;
  bool is_from_level_set = false;  ///< made of distances to a surface
};

/// Values at the cell centres of `bounds`, trilinear in between and fading into zeros
/// beyond the border, cut at the border [PBRT4, Sec. 11.4]. Empty if the box has no volume.
PlacedGrid place_in_box(const DensityGrid& values, const Bounds3& bounds);
/// The place alone: the same for all values that are not all zero.
GridPlace place_in_box(Vec3i resolution, const Bounds3& bounds);

}  // namespace tyndall
