// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tyndall/image/image.h"
#include "tyndall/math/rgb.h"

namespace tyndall {

enum class ToneCurve {
  plain,   ///< clips at one
  filmic,  ///< Narkowicz's fit of the ACES curve [Narkowicz16]
};

/// How linear radiance becomes display values.
struct ToneMapping {
  float exposure = 0;  ///< [stops]: values are multiplied by 2^exposure first
  ToneCurve curve = ToneCurve::plain;
  /// Ordered dithering [Bayer73], so that smooth fog shows no bands. Keeps values that 8
  /// bits hold exactly.
  bool dither = false;
};

/// The sRGB transfer function and its inverse, per IEC 61966-2-1.
float srgb_from_linear(float x);
float linear_from_srgb(float x);
/// linear_from_srgb(value / 255), from a table.
float linear_from_srgb8(uint8_t value);

/// Linear to linear in [0, 1]; infinity gives 1.
Rgb tone_map(Rgb L, const ToneMapping& tone);

/// sRGB bytes r, g, b, row 0 on top. Pixels that are not a number become magenta, to be
/// seen. Precondition: image.has_rgb().
std::vector<uint8_t> srgb8_from_image(const Image& image, const ToneMapping& tone);

}  // namespace tyndall
