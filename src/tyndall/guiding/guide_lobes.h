// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/guiding/gaussian_mixture.h"
#include "tyndall/guiding/light_square.h"

namespace tyndall {

/// Where the components of a mixture on a light's square lie on the sphere, so that a
/// phase function can be multiplied into their weights.
struct GuideLobes {
  using Lanes = GaussianMixture::Lanes;

  /// Of a trained mixture.
  static GuideLobes of(const GaussianMixture& mixture, SquareMeasure measure);

  /// For each component the mean over it of the Henyey-Greenstein phase function of mean
  /// cosine g about the unit vector `axis`, which is given in the frame of the square; up
  /// to a factor. A component of mean cosine c turns g into g c, exactly if it were of that
  /// family itself.
  Lanes phase_factors(Vec3 axis, float g) const;

  Lanes x{}, y{}, z{};  ///< unit mean direction in the frame of the square
  Lanes cosine{};       ///< mean cosine about it
};

}  // namespace tyndall
