// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/phase_function.h"

namespace tyndall {

/// Samples at cell centres of a box, x fastest, then y, then z.
struct DensityGrid {
  Vec3i resolution;
  std::vector<float> values;  ///< finite, >= 0; resolution.x * y * z of them
};

/// A density grid that scales constant coefficients: trilinear between cell centres, samples
/// beyond the border count as zero, nothing outside the box [pbrt-v4 "uniformgrid"].
class GridMedium {
 public:
  /// `bounds` is the box in medium space. `density` scales all coefficients.
  GridMedium(DensityGrid density, Bounds3 bounds, Transform world_from_medium,
             MediumProperties properties, PhaseFunction phase);

  /// DDA over a coarse grid of majorants and means, empty cells skipped.
  class Segments;

  MediumProperties at(Vec3 p) const;
  Segments segments(const Ray& ray, float t_max) const;
  bool is_emissive() const;
  bool is_grey() const;
  const PhaseFunction& phase() const { return phase_; }
  Bounds3 world_bounds() const;

 private:
  PhaseFunction phase_;
  // The owner of this file completes the representation.
};

}  // namespace tyndall
