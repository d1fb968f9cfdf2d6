// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/false_color.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "tyndall/image/tone.h"

namespace tyndall {
namespace {

// sRGB, at even steps.
constexpr std::array<uint32_t, 10> stops = {0x000004, 0x1b0c41, 0x4a0c6b, 0x781c6d,
                                            0xa52c60, 0xcf4446, 0xed6925, 0xfb9b06,
                                            0xf7d13d, 0xfcffa4};

float component(uint32_t color, int shift) {
  return static_cast<float>((color >> shift) & 255) / 255;
}

}  // namespace

Rgb false_color(float x) {
  const float position = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
  const size_t i = std::min(static_cast<size_t>(position), stops.size() - 2);
  const float t = position - static_cast<float>(i);
  const auto mixed = [&](int shift) {
    return linear_from_srgb(
        std::lerp(component(stops[i], shift), component(stops[i + 1], shift), t));
  };
  return {mixed(16), mixed(8), mixed(0)};
}

Image false_color_image(std::span<const float> values, int width, int height, float low,
                        float high) {
  Image image(width, height);
  assert(values.size() == image.pixel_count());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float value = values[image.index(x, y)];
      const float relative = high > low ? (value - low) / (high - low) : 0;
      image.set_rgb(x, y, std::isnan(value) ? Rgb(value) : false_color(relative));
    }
  }
  return image;
}

}  // namespace tyndall
