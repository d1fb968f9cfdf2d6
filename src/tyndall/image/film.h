// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tyndall/image/image.h"
#include "tyndall/math/rgb.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// What one camera path found.
struct PathSample {
  Rgb L;
  Rgb albedo;       ///< of the first event, surface or medium
  Vec3 normal;      ///< of the first surface, world space; zero in a medium
  float depth = 0;  ///< distance to the first event [scene units]; zero if there is none
};

/// L with no component above `max`, its color kept: pbrt's maxcomponentvalue, for samples
/// and splats. What is not finite is left to the film.
Rgb limited(Rgb L, float max);

/// Samples that the film refused, by cause.
struct RejectedSamples {
  int64_t not_a_number = 0, infinite = 0, negative = 0;

  int64_t total() const { return not_a_number + infinite + negative; }
};

/// Running sums of a rectangle of pixels. Different pixels may be added to by different
/// threads; one pixel by one thread at a time.
class Film {
 public:
  /// `crop_min`, `crop_max` (exclusive) bound the rendered part of a picture of
  /// `full_size`.
  Film(Vec2i full_size, Vec2i crop_min, Vec2i crop_max);

  Vec2i full_size() const { return full_size_; }
  Vec2i crop_min() const { return crop_min_; }
  Vec2i crop_max() const { return crop_max_; }

  /// Adds a sample of the pixel (in full picture coordinates) with the weight of its
  /// filter. Radiance that is not finite or is negative counts as black and as rejected;
  /// guides (albedo, normal, depth) that are not finite count as zero.
  void add(Vec2i pixel, const PathSample& sample, float weight);
  /// Adds, to one more sample of each pixel, what splats have brought: `totals` has red,
  /// green and blue of each pixel of the crop, row by row, and may be negative where the
  /// filter is. Means and variances of samples and of splats are added. Totals that are not
  /// finite count as black and as rejected.
  void add_splats(std::span<const double> totals);
  /// The same where there are none.
  void add_no_splats() { ++splatted_; }

  /// Red, green and blue of a pixel.
  struct Estimate {
    std::array<double, 3> mean, variance;  ///< the latter of one sample, not of the mean
  };
  Estimate estimate(Vec2i pixel) const;

  /// R,G,B; variance.R,G,B (of the pixel's mean, as if its samples were independent; zero
  /// below two samples); albedo.R,G,B; normal.X,Y,Z (averages, not unit); depth.Z (average
  /// over the samples that hit something); spp.Y. A pixel without samples shows what a
  /// sampled one nearby has, but for its spp.Y, which is zero; without any it is black.
  Image develop() const;
  RejectedSamples rejected() const;
  /// Pixels without samples.
  int64_t unsampled() const;

 private:
  // Double, because a float mean stops moving after some ten thousand samples.
  struct Pixel {
    double mean[3] = {}, sum_squares[3] = {};  // [Welford62], of weight * L
    Rgb albedo;                                // sums
    Vec3 normal;
    float depth = 0;
    uint32_t count = 0, depth_count = 0;
    uint32_t nan = 0, inf = 0, negative = 0;
  };
  // Of the splats of all samples.
  struct Splats {
    std::array<double, 3> sum{}, sum_squares{};
  };
  void add_total(size_t pixel, std::span<const double, 3> total);
  double mean(size_t pixel, int channel) const;
  double variance(size_t pixel, int channel) const;
  static bool accept(Pixel& pixel, Rgb L);
  static void add_guides(Pixel& pixel, const PathSample& sample);
  std::vector<size_t> sampled_pixels() const;
  Pixel& at(Vec2i pixel) { return pixels_[index(pixel)]; }
  size_t index(Vec2i pixel) const;
  int width() const { return crop_max_.x - crop_min_.x; }
  int height() const { return crop_max_.y - crop_min_.y; }

  Vec2i full_size_, crop_min_, crop_max_;
  std::vector<Pixel> pixels_;
  std::vector<Splats> splats_;  // of each pixel; empty before add_splats()
  uint32_t splatted_ = 0;       // samples
};

}  // namespace tyndall
