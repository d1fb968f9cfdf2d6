// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/rgb.h"

namespace tyndall {

/// The colour of a black body of `temperature` [K]: Planck's spectrum scaled to a maximum
/// of one over all wavelengths, as in pbrt, seen by the CIE 1931 observer [WSS13]; channels
/// out of gamut are cut to zero. Black below 100 K; the colour of 40000 K above that.
Rgb blackbody_radiance(float temperature);

}  // namespace tyndall
