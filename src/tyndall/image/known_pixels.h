// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tyndall/math/vec.h"

namespace tyndall {

/// For each pixel of a picture, row by row, one that is known: itself, or one of the
/// smallest square around it that has any, of those that the picture consists of with sides
/// of 2, 4, 8 and so on. If none at all is known, each pixel stands for itself.
std::vector<size_t> known_pixels(Vec2i size,
                                 const std::function<bool(size_t pixel)>& is_known);

}  // namespace tyndall
