// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/rgb.h"

namespace tyndall {

/// What a medium is made of at one point.
struct MediumProperties {
  Rgb sigma_a;  ///< absorption [1/scene unit]
  Rgb sigma_s;  ///< scattering [1/scene unit]
  Rgb Le;       ///< emitted radiance; the source term is sigma_a * Le

  constexpr Rgb sigma_t() const { return sigma_a + sigma_s; }
};

/// A stretch of a ray with constant bounds on the extinction.
struct MediumSegment {
  float t_min, t_max;  ///< [scene units]
  Rgb majorant;        ///< >= sigma_t everywhere on the stretch [1/scene unit]
  Rgb mean;  ///< approximate mean of sigma_t, positive wherever sigma_t is: the proxy
};

}  // namespace tyndall
