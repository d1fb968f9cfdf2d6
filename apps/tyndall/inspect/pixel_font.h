// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tyndall/image/image.h"

namespace tyndall::app {

/// Letters of 5x7 pixels in cells of 6x9, lower case only; other characters are blank.
inline constexpr int letter_width = 6, letter_height = 9;

/// Writes with the top left corner at (x, y); what falls out of the image is left out.
void draw_text(Image& image, int x, int y, std::string_view text, Rgb color);

}  // namespace tyndall::app
