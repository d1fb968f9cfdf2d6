// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tyndall/image/image.h"

namespace tyndall {

/// The color of x in [0, 1], linear, clamped outside: from black over purple and orange to
/// pale yellow, monotonic in lightness ("inferno" [Smith15]).
Rgb false_color(float x);

/// An image of the values of one plane between `low` and `high`; not a number becomes
/// itself in all channels, which PNG shows as magenta. Precondition: `values` has the size
/// of the image.
Image false_color_image(std::span<const float> values, int width, int height, float low,
                        float high);

}  // namespace tyndall
