// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace tyndall::flip {

/// Three values of a pixel in one of the spaces below.
using Triple = std::array<double, 3>;

/// The opponent space in which the eye's contrast sensitivity is applied: linear in RGB,
/// with the scales of CIELAB [Andersson20].
Triple opponent_from_rgb(Triple rgb);
Triple rgb_from_opponent(Triple opponent);

/// CIELAB, with chroma lowered in the dark (the Hunt effect) [Andersson20, Eq. 4].
Triple hunt_lab_from_rgb(Triple rgb);

/// The HyAB distance, for large color differences [Andersson20, Eq. 3].
double hyab(Triple a, Triple b);

}  // namespace tyndall::flip
