// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/bounds.h"
#include "tyndall/media/placed_grid.h"

namespace tyndall {

/// The parameters of pbrt's procedural "cloud".
struct CloudParameters {
  float density = 1;
  float wispiness = 1;
  float frequency = 5;
};

/// The density of a procedural cloud at a point of its medium space, in [0, 1]: five
/// octaves of noise, thinning out from y = 0 to y = 1 [PBRT4, Sec. 11.4]. The noise is of
/// this project's own, so that clouds are alike pbrt's in kind, not in shape.
float cloud_density(const CloudParameters& parameters, Vec3 p);

/// The cloud in `bounds`, sampled finely enough for its smallest detail, but in at most
/// 192^3 points. Computed in parallel.
PlacedGrid make_cloud(const CloudParameters& parameters, const Bounds3& bounds);

}  // namespace tyndall
