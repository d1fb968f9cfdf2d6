// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/tone.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {
namespace {

float filmic(float x) {
  if (x > 1e4f) return 1;  // before the squares overflow
  return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f,
                    1.0f);
}

/// The 8 x 8 ordered dither matrix [Bayer73], as thresholds strictly between 0 and 1: the
/// bits of x ^ y and y, interleaved from the lowest on.
float bayer_threshold(int x, int y) {
  int rank = 0;
  for (int bit = 0; bit < 3; ++bit) {
    rank = rank << 2 | ((((x ^ y) >> bit) & 1) << 1) | ((y >> bit) & 1);
  }
  return (static_cast<float>(rank) + 0.5f) / 64;
}

uint8_t quantize(float x, float threshold) {
  return static_cast<uint8_t>(
      std::clamp(srgb_from_linear(x) * 255 + threshold, 0.0f, 255.0f));
}

}  // namespace

float srgb_from_linear(float x) {
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

float linear_from_srgb(float x) {
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

float linear_from_srgb8(uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t;
    for (size_t i = 0; i < t.size(); ++i)
      t[i] = linear_from_srgb(static_cast<float>(i) / 255);
    return t;
  }();
  return table[value];
}

Rgb tone_map(Rgb L, const ToneMapping& tone) {
  const Rgb x = clamp_negative(L * std::exp2(tone.exposure));
  if (tone.curve == ToneCurve::filmic) return {filmic(x.r), filmic(x.g), filmic(x.b)};
  return {std::min(x.r, 1.0f), std::min(x.g, 1.0f), std::min(x.b, 1.0f)};
}

std::vector<uint8_t> srgb8_from_image(const Image& image, const ToneMapping& tone) {
  const RgbPlanes planes = image.rgb_planes();
  std::vector<uint8_t> bytes;
  bytes.reserve(3 * image.pixel_count());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb L = planes[image.index(x, y)];
      if (std::isnan(L.r) || std::isnan(L.g) || std::isnan(L.b)) {
        bytes.insert(bytes.end(), {255, 0, 255});
        continue;
      }
      const Rgb mapped = tone_map(L, tone);
      const float threshold = tone.dither ? bayer_threshold(x, y) : 0.5f;
      for (int c = 0; c < 3; ++c) bytes.push_back(quantize(mapped[c], threshold));
    }
  }
  return bytes;
}

}  // namespace tyndall
