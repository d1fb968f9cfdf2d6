// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "tyndall/image/film.h"
#include "tyndall/image/filter.h"

namespace tyndall {

/// Light that arrives wherever on the film it likes.
struct Splat {
  Vec2 p_film;  ///< [pixels of the full picture]
  Rgb value;    ///< radiance times area of the film [pixels]
  /// How many times as likely as by samples of the camera; infinite if those do not find
  /// it.
  float ratio = std::numeric_limits<float>::infinity();
};

/// Collects splats, each for all pixels whose filter reaches it: for a pixel the expected
/// sum is what samples drawn from that filter have for their mean.
class SplatCanvas {
 public:
  SplatCanvas(const Filter& filter, Vec2i crop_min, Vec2i crop_max);

  /// Whether any pixel sees a splat there.
  bool is_seen(Vec2 p_film) const;
  /// Adds in the order of the batches, and of the splats of each, on many threads.
  void add(std::span<const std::vector<Splat>> batches);
  const Filter& filter() const { return *filter_; }
  /// Gives the sums, times `scale`, to the film as those of one sample, and starts anew.
  void give(Film& film, double scale);
  void clear();

 private:
  void add_to_rows(const Splat& splat, int first_row, int end_row);
  int width() const { return crop_max_.x - crop_min_.x; }
  int height() const { return crop_max_.y - crop_min_.y; }

  const Filter* filter_;
  Vec2i crop_min_, crop_max_;
  std::vector<double> sums_;  // red, green, blue of each pixel, row by row
};

}  // namespace tyndall
