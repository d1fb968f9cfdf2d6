// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/vec.h"

namespace tyndall {

/// A direction drawn from a phase function.
struct PhaseSample {
  Vec3 wi;      ///< unit, points away from the scattering point
  float value;  ///< p(wo, wi) [1/sr]
  float pdf;    ///< density of wi w.r.t. solid angle [1/sr]
};

}  // namespace tyndall
