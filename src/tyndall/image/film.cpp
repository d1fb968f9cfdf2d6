// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "tyndall/image/known_pixels.h"
#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

float to_float(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -largest, largest));
}

/// Adds the planes `layer`.`components`[i] and fills them with value_at(pixel)[i].
template <typename ValueAt>
void fill(Image& image, const std::string& layer, const std::string& components,
          ValueAt value_at) {
  for (int i = 0; i < static_cast<int>(components.size()); ++i) {
    const std::string component(1, components[static_cast<size_t>(i)]);
    std::vector<float>& values = image.channel(channel_name(layer, component)).values;
    for (size_t pixel = 0; pixel < values.size(); ++pixel)
      values[pixel] = value_at(pixel, i);
  }
}

}  // namespace

Rgb limited(Rgb L, float max) {
  const float largest = max_component(L);
  return largest > max && is_finite(L) ? L * (max / largest) : L;
}

Film::Film(Vec2i full_size, Vec2i crop_min, Vec2i crop_max)
    : full_size_(full_size), crop_min_(crop_min), crop_max_(crop_max) {
  assert(width() > 0 && height() > 0);
  pixels_.resize(static_cast<size_t>(width()) * static_cast<size_t>(height()));
}

size_t Film::index(Vec2i pixel) const {
  assert(crop_min_.x <= pixel.x && pixel.x < crop_max_.x);
  assert(crop_min_.y <= pixel.y && pixel.y < crop_max_.y);
  const Vec2i p = pixel - crop_min_;
  return static_cast<size_t>(p.y) * static_cast<size_t>(width()) + static_cast<size_t>(p.x);
}

bool Film::accept(Pixel& pixel, Rgb L) {
  if (is_finite(L) && min_component(L) >= 0) return true;
  if (std::isnan(L.r) || std::isnan(L.g) || std::isnan(L.b)) {
    ++pixel.nan;
  } else if (!is_finite(L)) {
    ++pixel.inf;
  } else {
    ++pixel.negative;
  }
  return false;
}

void Film::add_guides(Pixel& pixel, const PathSample& sample) {
  if (is_finite(sample.albedo)) pixel.albedo += sample.albedo;
  if (is_finite(sample.normal)) pixel.normal += sample.normal;
  if (sample.depth > 0 && std::isfinite(sample.depth)) {
    pixel.depth += sample.depth;
    ++pixel.depth_count;
  }
}

void Film::add(Vec2i position, const PathSample& sample, float weight) {
  Pixel& pixel = at(position);
  const Rgb L = accept(pixel, sample.L) ? sample.L : Rgb();
  ++pixel.count;
  for (int c = 0; c < 3; ++c) {
    const double value = static_cast<double>(weight) * static_cast<double>(L[c]);
    const double delta = value - pixel.mean[c];
    pixel.mean[c] += delta / pixel.count;
    pixel.sum_squares[c] += delta * (value - pixel.mean[c]);
  }
  add_guides(pixel, sample);
}

void Film::add_splats(std::span<const double> totals) {
  assert(totals.size() == 3 * pixels_.size());
  splats_.resize(pixels_.size());
  ++splatted_;
  parallel_for(static_cast<size_t>(height()), [&](size_t row) {
    const size_t first = row * static_cast<size_t>(width());
    for (size_t i = first; i < first + static_cast<size_t>(width()); ++i)
      add_total(i, totals.subspan(3 * i).first<3>());
  });
}

void Film::add_total(size_t pixel, std::span<const double, 3> total) {
  const double sum = total[0] + total[1] + total[2];
  if (!std::isfinite(sum)) {
    ++(std::isnan(sum) ? pixels_[pixel].nan : pixels_[pixel].inf);
    return;
  }
  for (size_t c = 0; c < 3; ++c) {
    splats_[pixel].sum[c] += total[c];
    splats_[pixel].sum_squares[c] += total[c] * total[c];
  }
}

double Film::mean(size_t pixel, int channel) const {
  const double mean = pixels_[pixel].mean[channel];
  if (splats_.empty()) return mean;
  return mean + splats_[pixel].sum[static_cast<size_t>(channel)] / splatted_;
}

// Of the mean. Samples and splats are independent.
double Film::variance(size_t pixel, int channel) const {
  const double n = pixels_[pixel].count;
  const double variance = n < 2 ? 0 : pixels_[pixel].sum_squares[channel] / (n * (n - 1));
  if (splats_.empty() || splatted_ < 2) return variance;
  const auto c = static_cast<size_t>(channel);
  const double k = splatted_, sum = splats_[pixel].sum[c];
  const double spread = splats_[pixel].sum_squares[c] - sum * sum / k;
  return variance + std::max(spread, 0.0) / (k * (k - 1));
}

Film::Estimate Film::estimate(Vec2i pixel) const {
  const size_t i = index(pixel);
  Estimate estimate{};
  for (int c = 0; c < 3; ++c) {
    estimate.mean[static_cast<size_t>(c)] = mean(i, c);
    estimate.variance[static_cast<size_t>(c)] = variance(i, c) * pixels_[i].count;
  }
  return estimate;
}

Image Film::develop() const {
  Image image(width(), height());
  image.offset = crop_min_;
  image.full_size = full_size_;
  const std::vector<size_t> sampled = sampled_pixels();
  const auto shown = [&](size_t i) { return sampled.empty() ? i : sampled[i]; };
  const auto mean_of = [](float sum, uint32_t count) {
    return sum * (1 / static_cast<float>(std::max(count, 1u)));
  };
  fill(image, "", "RGB", [&](size_t i, int c) { return to_float(mean(shown(i), c)); });
  fill(image, "variance", "RGB",
       [&](size_t i, int c) { return to_float(variance(shown(i), c)); });
  fill(image, "albedo", "RGB", [&](size_t i, int c) {
    const Pixel& pixel = pixels_[shown(i)];
    return mean_of(pixel.albedo[c], pixel.count);
  });
  fill(image, "normal", "XYZ", [&](size_t i, int c) {
    const Pixel& pixel = pixels_[shown(i)];
    return mean_of(pixel.normal[c], pixel.count);
  });
  fill(image, "depth", "Z", [&](size_t i, int) {
    const Pixel& pixel = pixels_[shown(i)];
    return pixel.depth / static_cast<float>(std::max(pixel.depth_count, 1u));
  });
  fill(image, "spp", "Y",
       [&](size_t i, int) { return static_cast<float>(pixels_[i].count); });
  return image;
}

// Empty if all are.
std::vector<size_t> Film::sampled_pixels() const {
  if (unsampled() == 0) return {};
  return known_pixels({width(), height()}, [&](size_t i) { return pixels_[i].count > 0; });
}

int64_t Film::unsampled() const { return std::ranges::count(pixels_, 0u, &Pixel::count); }

RejectedSamples Film::rejected() const {
  RejectedSamples sum;
  for (const Pixel& pixel : pixels_) {
    sum.not_a_number += pixel.nan;
    sum.infinite += pixel.inf;
    sum.negative += pixel.negative;
  }
  return sum;
}

}  // namespace tyndall
