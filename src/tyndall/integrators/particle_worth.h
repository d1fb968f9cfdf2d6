// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tyndall/image/film.h"
#include "tyndall/image/splat_canvas.h"

namespace tyndall {

/// How many particles are worth what they cost, by what they find and what the picture so
/// far varies by, relative to the squared radiance of its surroundings.
///
/// A splat of value v that is r times as likely by N particles as by a walk stands for an
/// integrand f of which walks alone have the second moment f^2 / p = (v / N)^2 (1 + r)^2 /
/// r. With s N particles, walks and particles together have that of v^2 (1 + r)^2 (1 / r +
/// k s) / (1 + s r)^2 / N^2, where k is what the pixel filter makes of a splat's square.
/// The product of variance and cost is to be least.
class ParticleWorth {
 public:
  /// Candidates for s; the first one leaves all to walks.
  static constexpr std::array<double, 5> shares{0, 1.0 / 16, 1.0 / 4, 1, 4};
  using Moments = std::array<double, shares.size()>;

  /// `film` has at least two samples of each pixel, and bounds the life of the object.
  ParticleWorth(const Film& film, const Filter& filter);

  /// Relative second moments of what splats stand for, for each share of the `count`
  /// particles that made them, summed over all pixels.
  Moments moments(const std::vector<Splat>& splats, double count,
                  double imaging_ratio) const;
  /// The share of the particles traced so far that is to be traced from now on, by their
  /// moments(), and by what the walks to one sample of each pixel and all particles cost.
  double best_share(const Moments& moments, double walk_cost, double particle_cost) const;

 private:
  size_t block_of(Vec2 p_film) const;

  const Film* film_;
  Vec2i blocks_;
  std::vector<double> weights_;  // of blocks of pixels: one over the squared radiance
  double variance_ = 0;          // relative, summed over the pixels, without the worst
  double filter_square_ = 0;
};

}  // namespace tyndall
