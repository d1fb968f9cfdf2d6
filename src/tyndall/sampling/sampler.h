// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tyndall/math/vec.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

enum class SamplerKind {
  independent,  ///< counter-based pseudo-random numbers
  sobol,        ///< shuffled, Owen-scrambled Sobol pairs [Burley20]; needs no sample count
};

/// The uniform numbers of one path. A pure function of its arguments and of the order of
/// calls, whatever thread asks: sample `index` of `pixel` is the same in every run with the
/// same seed.
class Sampler {
 public:
  Sampler(SamplerKind kind, uint64_t seed, Vec2i pixel, uint32_t index);

  Vec2i pixel() const { return pixel_; }

  /// Uniform in [0, 1); takes one dimension.
  float next_1d();
  /// Uniform in [0, 1)^2; takes one dimension pair, well distributed over the pixel's
  /// samples.
  Vec2 next_2d();
  /// Leaves out one call of either, whose numbers nobody needs, so that later ones stay the
  /// same.
  void skip() { ++dimension_; }
  /// Goes on with a block of dimensions of its own, number `block` > 0: what is drawn of
  /// it is well distributed over the pixel's samples whatever each of them drew before.
  void start_block(uint32_t block) { dimension_ = block * block_size; }
  /// A stream for loops of unknown length (tracking), independent of all other dimensions.
  RandomStream fork();

 private:
  static constexpr uint32_t block_size = 32;

  SamplerKind kind_;
  Vec2i pixel_;
  uint32_t index_, reversed_index_;
  uint32_t dimension_ = 0;
  uint64_t key_;  // hash of seed and pixel, and of the index if independent
};

}  // namespace tyndall
