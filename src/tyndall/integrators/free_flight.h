// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/medium.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// What a walk carries whose distances are drawn for one channel, the hero.
struct Carried {
  Rgb beta{1};      ///< over the hero's density
  Rgb spectral{1};  ///< density of each channel for the same walk, relative to the hero's
};

/// A free flight through one medium.
struct FreeFlight {
  std::optional<float> t;  ///< distance of the first real collision; empty: went through
  Carried carried;
};

/// Delta tracking along [0, t_max] of a ray. `is_chromatic` says whether any medium of the
/// scene is: otherwise what goes through carries what it carried.
FreeFlight sample_free_flight(const Medium& medium, const Ray& ray, float t_max, int hero,
                              bool is_chromatic, const Carried& carried, RandomStream& rng);

}  // namespace tyndall
