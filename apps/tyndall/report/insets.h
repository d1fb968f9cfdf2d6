// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tyndall/image/image.h"

namespace tyndall::app {

/// A square part of a picture.
struct Inset {
  int x = 0, y = 0, size = 0;  ///< [pixels]
};

/// The `count` squares, apart from one another, where the images differ most from the
/// reference: by the sum of relative square errors, each pixel's cut off at one so that a
/// single firefly does not choose. Fewer if the picture is too small.
std::vector<Inset> choose_insets(const std::vector<const Image*>& images,
                                 const Image& reference, int count);

Image cut_out(const Image& image, const Inset& inset);

}  // namespace tyndall::app
