// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/vec.h"

namespace tyndall {

/// A half-line; `d` is a unit vector, so that distances along it are in scene units.
struct Ray {
  Vec3 o, d;

  Vec3 at(float t) const { return o + d * t; }
};

}  // namespace tyndall
