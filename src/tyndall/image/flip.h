// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tyndall/image/image.h"

namespace tyndall {

/// Pixels per degree of the viewing conditions that [Andersson20] proposes: 0.7 m before a
/// monitor 0.7 m and 3840 pixels wide.
constexpr double flip_pixels_per_degree =
    0.7 * (3840 / 0.7) * (3.14159265358979323846 / 180);

/// The difference that a person who flips between the two display images would see, per
/// pixel in [0, 1], row-major [Andersson20]. Both are exposed by 2^exposure and clipped
/// first. Pixels that are not finite in either image count as equal. Precondition: the
/// images have R, G, B and the same size.
std::vector<float> ldr_flip(const Image& image, const Image& reference, float exposure = 0,
                            double pixels_per_degree = flip_pixels_per_degree);

/// The exposures [stops] between which hdr_flip() looks, from the reference.
struct ExposureRange {
  double start = 0, stop = 0;
  int count = 2;
};
ExposureRange hdr_flip_exposures(const Image& reference);

/// The largest LDR difference over a range of exposures, tone-mapped by the ACES curve
/// [Andersson21]; otherwise as ldr_flip().
std::vector<float> hdr_flip(const Image& image, const Image& reference,
                            double pixels_per_degree = flip_pixels_per_degree);

/// hdr_flip() of several images against one reference, in less time than one by one; up to
/// four exposures at a time run in threads.
std::vector<std::vector<float>> hdr_flip(const std::vector<const Image*>& images,
                                         const Image& reference,
                                         double pixels_per_degree = flip_pixels_per_degree);

}  // namespace tyndall
