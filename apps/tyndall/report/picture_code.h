// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tyndall/image/image.h"

/// High dynamic range pictures for the page, small enough for four of them at 1920 x 1080.
namespace tyndall::app {

/// How radiance becomes a level: linear near black, logarithmic above.
///   level = round(steps log2(1 + x / floor))
struct LevelScale {
  double floor = 1e-3;  ///< radiance up to which levels are about linear
  int steps = 32;       ///< levels per stop: 32 are 2.2 %

  uint16_t level(float x) const;
  double radiance(uint16_t level) const;
};

/// Infinity and not a number.
constexpr uint16_t infinite_level = 65534, not_a_number_level = 65535;

/// A scale for these images: its floor is 1/256 of the reference's median luminance.
LevelScale choose_scale(const Image& reference, int steps);

/// The levels of G, then of R and B less those of G modulo 2^16; each as packed by
/// pack_plane(). Precondition: image.has_rgb().
std::string encode_picture(const Image& image, const LevelScale& scale);

/// Values in [0, 1] in 64 levels, packed as one plane.
std::string encode_map(std::span<const float> values, int width);

/// Takes from each value the mean of its left and upper neighbors (the one there is, or
/// zero), folds the sign into the lowest bit, stores the low bytes and then the high bytes.
std::string pack_plane(const std::vector<uint16_t>& values, int width);

/// zlib's format, which browsers call "deflate".
std::string deflate_bytes(const std::string& bytes);

}  // namespace tyndall::app
