// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/image/image.h"

namespace tyndall {

/// Whether two images have the same expectation, by z-tests from their variance layers.
struct BiasTest {
  double mean_difference = 0;  ///< image minus reference, over pixels and channels
  double standard_error = 0;   ///< of mean_difference
  double p_value = 1;          ///< two-sided
  int tiles = 0;               ///< squares of tile_size pixels, cut off at the border
  int rejected_tiles = 0;      ///< at 5 % for all together [Sidak67]
  double smallest_tile_p_value = 1;
  bool reference_has_variance = true;  ///< false: the reference was taken as exact
};

constexpr int bias_tile_size = 16;

/// Empty if the image has no variance layer. Pixels that are not finite anywhere are left
/// out.
///
/// The variance layers know nothing of the correlation between channels; it is taken as
/// complete, which is right for grey light and else makes the test milder. With few samples
/// of a heavy tail the variance is underestimated where the mean is: use at least some
/// hundred samples per tile before believing a rejection. Throws std::invalid_argument if
/// the images cannot be compared.
std::optional<BiasTest> test_bias(const Image& image, const Image& reference);

}  // namespace tyndall
