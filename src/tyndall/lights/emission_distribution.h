// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "tyndall/geometry/grid_space.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/rgb.h"
#include "tyndall/math/transform.h"
#include "tyndall/math/vec.h"
#include "tyndall/sampling/tabulated.h"

namespace tyndall {

/// Points in a glowing volume, drawn roughly in proportion to the power emitted there, and
/// the directions towards them. Piecewise constant on a coarse grid over the volume's box.
class EmissionDistribution {
 public:
  static constexpr int resolution = 32;  ///< cells along an axis
  static constexpr size_t cell_count = size_t{resolution} * resolution * resolution;

  /// `means` are the means of sigma_a Le over the cells that `box` is cut into, x fastest:
  /// cell_count of them, finite and not negative. Precondition: the box has a volume.
  EmissionDistribution(const Transform& world_from_grid, const Bounds3& box,
                       std::span<const Rgb> means);

  struct Sample {
    Vec3 p;
    float pdf_volume;  ///< density of p w.r.t. volume [1/scene unit^3]
  };
  Sample sample(float u_cell, Vec3 u) const;
  /// Density of sample() at p; positive wherever the volume can emit.
  float pdf_volume(Vec3 p) const;
  /// Density of the direction from `p` to the point of sample() [1/sr]: all points on the
  /// line count. `w` is unit.
  float pdf_direction(Vec3 p, Vec3 w) const;
  /// Estimate of the power emitted into all directions: 4 pi times the integral of sigma_a
  /// Le.
  Rgb power() const { return power_; }
  Bounds3 bounds() const;  ///< in world space

 private:
  Transform world_from_cells_;
  GridSpace space_;  // of the cells, which are unit cubes
  float volume_;     // of a cell, in world space
  DiscreteDistribution cells_;
  Rgb power_;
};

}  // namespace tyndall
