// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/bias_test.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tyndall/image/metrics.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

/// Sums over pixels of the channels' mean difference and of its variance.
struct DifferenceSums {
  double difference = 0, variance = 0;
  int64_t pixels = 0;

  void add(const DifferenceSums& o) {
    difference += o.difference;
    variance += o.variance;
    pixels += o.pixels;
  }
  double p_value() const {
    if (variance > 0) {
      return std::erfc(std::abs(difference) / std::sqrt(variance) / std::numbers::sqrt2);
    }
    return difference == 0 ? 1 : 0;
  }
};

/// The variance of the mean over fully correlated channels.
double variance_of_channel_mean(Rgb variance) {
  return sqr((std::sqrt(double{variance.r}) + std::sqrt(double{variance.g}) +
              std::sqrt(double{variance.b})) /
             3);
}

class Comparison {
 public:
  Comparison(const Image& image, const Image& reference)
      : image_(image),
        x_(image.rgb_planes()),
        r_(reference.rgb_planes()),
        x_variance_(image.rgb_planes("variance")) {
    if (reference.has_rgb("variance")) r_variance_ = reference.rgb_planes("variance");
  }

  bool reference_has_variance() const { return r_variance_.has_value(); }

  DifferenceSums tile(int left, int top) const {
    DifferenceSums sums;
    for (int y = top; y < std::min(top + bias_tile_size, image_.height()); ++y) {
      for (int x = left; x < std::min(left + bias_tile_size, image_.width()); ++x) {
        add_pixel(image_.index(x, y), sums);
      }
    }
    return sums;
  }

 private:
  void add_pixel(size_t i, DifferenceSums& sums) const {
    const Rgb r_variance = r_variance_ ? (*r_variance_)[i] : Rgb();
    const Rgb x = x_[i], r = r_[i], x_variance = x_variance_[i];
    if (!is_finite(x) || !is_finite(r) || !is_finite(x_variance) ||
        !is_finite(r_variance)) {
      return;
    }
    double difference = 0;
    for (int c = 0; c < 3; ++c) difference += double{x[c]} - double{r[c]};
    sums.difference += difference / 3;
    sums.variance +=
        variance_of_channel_mean(x_variance) + variance_of_channel_mean(r_variance);
    ++sums.pixels;
  }

  const Image& image_;
  RgbPlanes x_, r_, x_variance_;
  std::optional<RgbPlanes> r_variance_;
};

}  // namespace

std::optional<BiasTest> test_bias(const Image& image, const Image& reference) {
  check_comparable(image, reference);
  if (!image.has_rgb("variance")) return std::nullopt;
  const Comparison comparison(image, reference);
  std::vector<double> p_values;
  DifferenceSums whole;
  for (int y = 0; y < image.height(); y += bias_tile_size) {
    for (int x = 0; x < image.width(); x += bias_tile_size) {
      const DifferenceSums tile = comparison.tile(x, y);
      whole.add(tile);
      if (tile.pixels > 0) p_values.push_back(tile.p_value());
    }
  }
  if (p_values.empty()) return std::nullopt;
  BiasTest test;
  test.mean_difference = whole.difference / static_cast<double>(whole.pixels);
  test.standard_error = std::sqrt(whole.variance) / static_cast<double>(whole.pixels);
  test.p_value = whole.p_value();
  test.tiles = static_cast<int>(p_values.size());
  const double level = -std::expm1(std::log1p(-0.05) / test.tiles);
  test.rejected_tiles = static_cast<int>(
      std::count_if(p_values.begin(), p_values.end(), [&](double p) { return p < level; }));
  test.smallest_tile_p_value = *std::min_element(p_values.begin(), p_values.end());
  test.reference_has_variance = comparison.reference_has_variance();
  return test;
}

}  // namespace tyndall
