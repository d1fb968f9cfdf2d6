// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tyndall/image/image.h"

namespace tyndall {

struct MetricOptions {
  double epsilon = 0.01;           ///< in relMSE, added to the squared reference
  double trimmed_fraction = 1e-3;  ///< of the pixels, left out of the trimmed relMSE
  float exposure = 0;     ///< [stops] of the display images that PSNR and LDR-FLIP see
  bool with_flip = true;  ///< the slow ones
};

/// How far an image is from its reference. Pixels that are not finite in either image are
/// counted and left out of everything else. All errors are over pixels and the three
/// channels alike.
struct ImageErrors {
  double mse = 0;              ///< mean of (x - r)^2
  double rel_mse = 0;          ///< mean of (x - r)^2 / (r^2 + epsilon)
  double rel_mse_trimmed = 0;  ///< without the pixels where that is largest
  double smape = 0;            ///< mean of 2 |x - r| / (|x| + |r|), in [0, 2]
  double psnr = 0;             ///< [dB] of the clipped sRGB display images, peak 1
  double percentile_99_9 = 0;  ///< of the pixels' mean |x - r|; shows fireflies
  double mean = 0, reference_mean = 0;
  std::optional<double> ldr_flip;  ///< mean [Andersson20], of the clipped display images
  std::optional<double> hdr_flip;  ///< mean [Andersson21]
  int64_t not_finite = 0, reference_not_finite = 0;  ///< pixels
};

/// Throws std::invalid_argument if the sizes differ or R, G, B are missing in one.
ImageErrors measure_errors(const Image& image, const Image& reference,
                           const MetricOptions& options = {});

/// Per pixel the mean over the channels of (x - r)^2 / (r^2 + epsilon), row-major; NaN
/// where either is not finite. Throws as measure_errors() does.
std::vector<float> relative_square_errors(const Image& image, const Image& reference,
                                          double epsilon);

/// Throws std::invalid_argument if the two cannot be compared pixel by pixel.
void check_comparable(const Image& image, const Image& reference);

}  // namespace tyndall
