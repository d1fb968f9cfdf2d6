// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "tyndall/math/constants.h"
#include "tyndall/math/scalar.h"

namespace tyndall {

/// The angle of the vector (x, y), y >= 0, from the x axis [rad]: in [0, pi], off by at
/// most 2e-4, zero for the vector zero. For choosing by; a third of the cost of std::atan2.
inline float fast_angle(float x, float y) {
  const float run = magnitude(x), small = std::min(run, y), large = std::max(run, y);
  if (!(large > 0)) return 0;
  // A minimax polynomial for the arc tangent on [0, 1].
  const float r = small / large, s = r * r;
  const float arc =
      r * (0.9998660f +
           s * (-0.3302995f + s * (0.1801410f + s * (-0.0851330f + s * 0.0208351f))));
  const float acute = y > run ? 0.5f * pi - arc : arc;
  return x < 0 ? pi - acute : acute;
}

}  // namespace tyndall
