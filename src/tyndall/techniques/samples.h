// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/vec.h"

namespace tyndall {

/// A distance drawn along a ray.
struct DistanceSample {
  float t;      ///< distance from the ray origin [scene units]
  float pdf_t;  ///< density w.r.t. length along the ray [1/scene unit]; positive and finite
};

/// A direction drawn at the first of two scattering vertices.
struct DoubleDirectionSample {
  Vec3 w;     ///< unit, points away from the vertex
  float pdf;  ///< density w.r.t. solid angle [1/sr]; positive and finite
};

/// `pdf` where it is a density, and zero where rounding or bad input left something else.
constexpr float density_or_zero(float pdf) { return pdf > 0 && pdf < infinity ? pdf : 0; }

}  // namespace tyndall
