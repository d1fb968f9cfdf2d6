// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "tyndall/image/flip.h"
#include "tyndall/image/tone.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

double mean_of_channels(Rgb a) { return (double{a.r} + double{a.g} + double{a.b}) / 3; }

/// The sum over the channels of f(x, r), divided by three.
template <typename F>
double channel_mean(Rgb x, Rgb r, F f) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += f(double{x[c]}, double{r[c]});
  return sum / 3;
}

double relative_square(Rgb x, Rgb r, double epsilon) {
  return channel_mean(x, r,
                      [&](double a, double b) { return sqr(a - b) / (sqr(b) + epsilon); });
}

double smape(double a, double b) {
  const double sum = std::abs(a) + std::abs(b);
  return sum > 0 ? 2 * std::abs(a - b) / sum : 0;
}

double display_square(Rgb x, Rgb r, const ToneMapping& tone) {
  return channel_mean(tone_map(x, tone), tone_map(r, tone), [](double a, double b) {
    return sqr(double{srgb_from_linear(static_cast<float>(a))} -
               double{srgb_from_linear(static_cast<float>(b))});
  });
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The smallest value that at least `fraction` of the values do not exceed.
double percentile(std::vector<double> values, double fraction) {
  const auto n = static_cast<double>(values.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::max(std::ceil(fraction * n) - 1, 0.0));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<size_t>(rank)];
}

/// The mean without the largest ceil(fraction * n) values, though never without all.
double trimmed_mean(std::vector<double> values, double fraction) {
  const auto n = static_cast<double>(values.size());
  const auto kept = static_cast<std::ptrdiff_t>(std::max(n - std::ceil(fraction * n), 1.0));
  std::nth_element(values.begin(), values.begin() + (kept - 1), values.end());
  return std::accumulate(values.begin(), values.begin() + kept, 0.0) /
         static_cast<double>(kept);
}

double mean_over(const std::vector<float>& map, const std::vector<size_t>& pixels) {
  double total = 0;
  for (size_t i : pixels) total += double{map[i]};
  return total / static_cast<double>(pixels.size());
}

/// Counts pixels that are not finite; returns the others.
std::vector<size_t> finite_pixels(const RgbPlanes& x, const RgbPlanes& r, size_t count,
                                  ImageErrors& errors) {
  std::vector<size_t> pixels;
  for (size_t i = 0; i < count; ++i) {
    errors.not_finite += !is_finite(x[i]);
    errors.reference_not_finite += !is_finite(r[i]);
    if (is_finite(x[i]) && is_finite(r[i])) pixels.push_back(i);
  }
  return pixels;
}

void add_flip(const Image& image, const Image& reference, float exposure,
              const std::vector<size_t>& pixels, ImageErrors& errors) {
  errors.ldr_flip = mean_over(ldr_flip(image, reference, exposure), pixels);
  errors.hdr_flip = mean_over(hdr_flip(image, reference), pixels);
}

}  // namespace

void check_comparable(const Image& image, const Image& reference) {
  if (!image.has_rgb() || !reference.has_rgb()) {
    throw std::invalid_argument(fmt::format("the {} has no R, G and B channels",
                                            image.has_rgb() ? "reference" : "image"));
  }
  if (image.width() != reference.width() || image.height() != reference.height()) {
    throw std::invalid_argument(
        fmt::format("the image has {} x {} pixels, the reference {} x {}", image.width(),
                    image.height(), reference.width(), reference.height()));
  }
}

ImageErrors measure_errors(const Image& image, const Image& reference,
                           const MetricOptions& options) {
  check_comparable(image, reference);
  const RgbPlanes x = image.rgb_planes(), r = reference.rgb_planes();
  ImageErrors errors;
  const std::vector<size_t> pixels = finite_pixels(x, r, image.pixel_count(), errors);
  if (pixels.empty()) throw std::invalid_argument("no pixel is finite in both images");
  const ToneMapping display{.exposure = options.exposure};
  double square = 0, smape_sum = 0, display_sum = 0;
  std::vector<double> relative, absolute;
  for (size_t i : pixels) {
    square += channel_mean(x[i], r[i], [](double a, double b) { return sqr(a - b); });
    smape_sum += channel_mean(x[i], r[i], smape);
    display_sum += display_square(x[i], r[i], display);
    relative.push_back(relative_square(x[i], r[i], options.epsilon));
    absolute.push_back(
        channel_mean(x[i], r[i], [](double a, double b) { return std::abs(a - b); }));
    errors.mean += mean_of_channels(x[i]);
    errors.reference_mean += mean_of_channels(r[i]);
  }
  const auto n = static_cast<double>(pixels.size());
  errors.mean /= n;
  errors.reference_mean /= n;
  errors.mse = square / n;
  errors.smape = smape_sum / n;
  errors.psnr = -10 * std::log10(display_sum / n);
  errors.rel_mse = sum(relative) / n;
  errors.rel_mse_trimmed = trimmed_mean(relative, options.trimmed_fraction);
  errors.percentile_99_9 = percentile(absolute, 0.999);
  if (options.with_flip) add_flip(image, reference, options.exposure, pixels, errors);
  return errors;
}

std::vector<float> relative_square_errors(const Image& image, const Image& reference,
                                          double epsilon) {
  check_comparable(image, reference);
  const RgbPlanes x = image.rgb_planes(), r = reference.rgb_planes();
  std::vector<float> map(image.pixel_count());
  for (size_t i = 0; i < map.size(); ++i) {
    const bool finite = is_finite(x[i]) && is_finite(r[i]);
    map[i] = finite ? static_cast<float>(relative_square(x[i], r[i], epsilon))
                    : std::numeric_limits<float>::quiet_NaN();
  }
  return map;
}

}  // namespace tyndall
