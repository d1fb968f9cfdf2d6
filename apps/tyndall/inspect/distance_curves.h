// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "apps/tyndall/inspect/raster_plot.h"
#include "tyndall/guiding/guiding_file.h"
#include "tyndall/scene/scene.h"

namespace tyndall::app {

/// Densities of the scattering vertex along a ray, and what they should be.
struct DistanceCurves {
  size_t light;
  Curve truth = {};        ///< the single scattering integrand by brute force, normalised
  Curve learned = {};      ///< what is sampled with the visibility of the file
  Curve equiangular = {};  ///< the same without visibility
  float learned_variance = {};  ///< relative, of one sample; the light is averaged over;
                                ///< -1 if no light arrives
  float equiangular_variance = {};  ///< the same without visibility
};

/// Along a camera ray, for the light of that index or the one most likely to be drawn.
/// Throws std::invalid_argument if the ray meets no medium, or the light is at infinity.
DistanceCurves distance_curves(const Scene& scene, const GuidingFile& file, const Ray& ray,
                               std::optional<size_t> light);

}  // namespace tyndall::app
