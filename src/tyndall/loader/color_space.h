// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "tyndall/math/rgb.h"

namespace tyndall::loader {

/// The color spaces that a scene may state its RGB values in.
enum class ColorSpace { srgb, dci_p3, rec2020, aces2065_1 };

/// Empty if pbrt-v4 knows no such color space.
std::optional<ColorSpace> color_space_by_name(std::string_view name);

/// Linear Rec. 709 values of the same color, white adapted by [Lam85]: grey stays grey.
/// Colors outside the Rec. 709 gamut have negative components.
Rgb rec709_from(ColorSpace space, Rgb color);

/// Linear Rec. 709 values of CIE XYZ, no adaptation.
Rgb rec709_from_xyz(float x, float y, float z);

}  // namespace tyndall::loader
