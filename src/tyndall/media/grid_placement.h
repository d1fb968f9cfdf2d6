// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/geometry/grid_space.h"
#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/placed_grid.h"

namespace tyndall {

/// Where a grid lies in the world. It is zero outside its box.
class GridPlacement {
 public:
  GridPlacement(const GridPlace& grid, const Transform& world_from_medium)
      : world_from_grid_(world_from_medium * grid.medium_from_grid),
        space_(world_from_grid_.inverse()),
        box_(grid.box),
        world_bounds_(bounds_of_box()) {}

  void move(Vec3d by) {  ///< in the world
    world_from_grid_ = Transform::translate(by) * world_from_grid_;
    space_ = space_.moved(by);
    world_bounds_ = bounds_of_box();
  }

  /// A point of the world in grid space.
  Vec3 point(Vec3 p) const { return space_.point(p); }
  /// The part of a ray that lies in the box; empty if none does.
  std::optional<GridSpace::Clip> clip(const Ray& ray, float t_max) const {
    return space_.clip(ray, t_max, box_);
  }
  bool contains(Vec3 p_grid) const { return box_.contains(p_grid); }

  const Transform& world_from_grid() const { return world_from_grid_; }
  /// In grid space; empty if the grid is nowhere.
  const Bounds3& box() const { return box_; }
  /// Of the box; empty if it is.
  const Bounds3& world_bounds() const { return world_bounds_; }

 private:
  Bounds3 bounds_of_box() const {
    return box_.is_empty() ? Bounds3() : world_from_grid_.bounds(box_);
  }

  Transform world_from_grid_;
  GridSpace space_;
  Bounds3 box_;
  Bounds3 world_bounds_;
};

}  // namespace tyndall
