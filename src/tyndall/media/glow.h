// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/geometry/ray.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/medium.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// Unbiased estimate of the radiance that `medium` emits along the ray up to t_max, which
/// may be infinite, towards the ray's origin: the integral of transmittance times sigma_a
/// Le. Times `transmittance`, which is multiplied by an estimate of the medium's own, in
/// [0, 1]. Exact in homogeneous media.
Rgb estimate_glow(const Medium& medium, const Ray& ray, float t_max, RandomStream& rng,
                  Rgb& transmittance);

}  // namespace tyndall
