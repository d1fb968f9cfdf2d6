// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/geometry/ray.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/medium.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// How transmittance is estimated in media that are not homogeneous. All are unbiased in
/// every channel; the channels share one random walk.
enum class TransmittanceMethod {
  ratio_tracking,           ///< in [0, 1] [NSJ14]
  residual_ratio_tracking,  ///< never negative [NSJ14]
  ray_marching,             ///< sometimes below 0 or above 1 [KdPN21]
};

/// The least variance x time of pixels (docs/performance.md), and never negative, as radiance
/// must not be.
inline constexpr TransmittanceMethod default_transmittance_method =
    TransmittanceMethod::residual_ratio_tracking;

/// An unbiased estimate of the transmittance of `medium` along the ray up to t_max, which
/// may be infinite. Exact in homogeneous media.
Rgb estimate_transmittance(const Medium& medium, const Ray& ray, float t_max,
                           RandomStream& rng,
                           TransmittanceMethod method = default_transmittance_method);

}  // namespace tyndall
