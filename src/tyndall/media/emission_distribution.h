// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/math/bounds.h"
#include "tyndall/math/rgb.h"
#include "tyndall/math/transform.h"
#include "tyndall/math/vec.h"
#include "tyndall/media/grid_space.h"
#include "tyndall/media/medium.h"
#include "tyndall/sampling/tabulated.h"

namespace tyndall {

/// Points in a glowing medium, drawn roughly in proportion to the power emitted there: for
/// next event estimation to the volume. Piecewise constant on a coarse grid over the
/// medium's box.
class EmissionDistribution {
 public:
  /// Empty if the medium is dark, or homogeneous and thus without bounds of its own.
  static std::optional<EmissionDistribution> make(const Medium& medium);

  struct Sample {
    Vec3 p;
    float pdf_volume;  ///< density of p w.r.t. volume [1/scene unit^3]
  };
  Sample sample(float u_cell, Vec3 u) const;
  /// Density of sample() at p; positive wherever the medium can emit.
  float pdf_volume(Vec3 p) const;
  /// Estimate of the power emitted into all directions: 4 pi times the integral of sigma_a
  /// Le.
  Rgb power() const { return power_; }

 private:
  EmissionDistribution(const Medium& medium, const Transform& world_from_grid,
                       const Bounds3& box);

  Bounds3 cell_box(size_t index) const;

  Transform world_from_grid_;
  GridSpace space_;
  Bounds3 box_;   // in grid space
  float volume_;  // of a cell, in world space
  DiscreteDistribution cells_;
  Rgb power_;
};

}  // namespace tyndall
