// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "apps/tyndall/parse_values.h"
#include "tyndall/image/image.h"

namespace tyndall::app {

/// Which error of an image against a reference to show.
enum class ErrorKind {
  difference,  ///< image minus reference, per channel
  absolute,    ///< the mean over the channels of |difference|
  relative,    ///< the mean over the channels of difference^2 / (reference^2 + 0.01)
  flip,        ///< of the clipped display images
  hdr_flip,
};

/// Throws std::invalid_argument for an unknown name.
ErrorKind parse_error_kind(const std::string& name);

/// All below keep offset, full size and attributes of the image where they still hold.

/// The layer as R, G, B: "albedo" of albedo.R,G,B, "normal" of normal.X,Y,Z, "depth" or
/// "depth.Z" of the single channel. Throws std::invalid_argument with the names of the
/// layers that there are.
Image select_layer(const Image& image, const std::string& layer);

/// Throws UsageError for a window without pixels.
Image crop_image(const Image& image, const CropWindow& window);

/// R, G, B times 2^stops, and their variance times its square.
Image expose_image(Image image, float stops);

/// The error as R, G, B. Throws std::invalid_argument if the two cannot be compared.
Image error_image(const Image& image, const Image& reference, ErrorKind kind);

/// The left half of one image beside the right half of another, as R, G, B. Throws
/// std::invalid_argument if the two cannot be compared.
Image split_image(const Image& left, const Image& right);

struct ValueRange {
  float low, high;
};

/// The mean of R, G, B in false color from the range's low to high; without a range from 0,
/// or the smallest value if that is below, to the 99.9th percentile. `range` becomes the
/// one taken.
Image to_false_color(const Image& image, std::optional<ValueRange>& range);

}  // namespace tyndall::app
