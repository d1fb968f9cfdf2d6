// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tyndall/math/constants.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// What one random decision of a path taught: at `p` the direction `wi` was chosen, and so
/// much came of it. Samples of weight zero are to be reported too.
struct TrainingSample {
  /// Unique within a pass and independent of threads, such as a hash of pixel, sample and
  /// vertex: samples are taken in the order of their keys.
  uint64_t key = 0;
  Vec3 p;                ///< where the direction was chosen
  Vec3 wi;               ///< unit, the direction
  Vec3 light_direction;  ///< unit, from p to the light that the sample connected to
  /// Radiance that was estimated to arrive at p from wi, phase function at p left out,
  /// divided by the density of wi; for the light alone, not divided by the probability of
  /// choosing it.
  float weight = 0;
  float pdf = 0;        ///< density that wi was drawn with [1/sr]
  float phase_pdf = 0;  ///< density of wi by phase sampling at p [1/sr]
  /// Densities of wi by the record's mixture and by joint sampling, as the render uses them
  /// [1/sr]; zero: those of the guide without regard to the phase function at p.
  float mixture_pdf = 0, joint_pdf = 0;
  /// The share of the light that is scattered on: the phase function at p, up to a factor
  /// that is the same for all samples. Shares are learned for the product.
  float scattered = 1;
  float light_distance = infinity;    ///< infinity for lights at infinity
  float scatter_distance = infinity;  ///< to the next vertex along wi; infinity if none
  float occluder_distance =
      infinity;          ///< from p to what blocked the sample; infinity if none
  float sigma_t = 0;     ///< mean extinction around p [1/scene unit]
  uint32_t cluster = 0;  ///< of the light
};

/// Samples of one tile or thread, in any order.
using TrainingBuffer = std::vector<TrainingSample>;

}  // namespace tyndall
