// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "tyndall/geometry/cell_walk.h"
#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"

namespace tyndall {

/// The affine map from world space to the sample coordinates of a grid, in double precision
/// so that a grid far from the origin, or seen from afar, is not torn.
class GridSpace {
 public:
  GridSpace() : GridSpace(Transform()) {}
  explicit GridSpace(const Transform& grid_from_world);

  /// Of a grid that is moved in the world.
  GridSpace moved(Vec3d by) const;

  Vec3 point(Vec3 p) const { return {row(0, p, 1), row(1, p, 1), row(2, p, 1)}; }

  /// A ray in grid space, and the part of it that lies in a box.
  struct Clip {
    GridRay ray;     ///< starts where the clipped ray enters the box
    float t_offset;  ///< distance from the origin of the world ray to that point
    float length;    ///< of the part in the box [scene units]
  };
  /// Empty if the ray does not meet `box` (in grid space) in (0, t_max).
  std::optional<Clip> clip(const Ray& ray, float t_max, const Bounds3& box) const;

 private:
  float row(size_t i, Vec3 v, double w) const {
    const std::array<double, 4>& m = m_[i];
    return static_cast<float>(m[0] * double{v.x} + m[1] * double{v.y} + m[2] * double{v.z} +
                              m[3] * w);
  }

  std::array<std::array<double, 4>, 3> m_;
};

}  // namespace tyndall
