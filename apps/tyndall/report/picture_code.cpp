// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/picture_code.h"

#define ZLIB_CONST
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

namespace tyndall::app {

namespace {

/// Of signed values, because differences of channels wrap around zero.
int predict(const std::vector<uint16_t>& values, size_t i, size_t width) {
  const auto value = [&](size_t k) { return int{static_cast<int16_t>(values[k])}; };
  const bool has_left = i % width != 0, has_above = i >= width;
  if (has_left && has_above) return (value(i - 1) + value(i - width)) >> 1;
  if (has_left) return value(i - 1);
  return has_above ? value(i - width) : 0;
}

/// 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
uint16_t fold_sign(uint16_t difference) {
  const auto value = static_cast<int16_t>(difference);
  return static_cast<uint16_t>((difference << 1) ^ (value < 0 ? 0xffff : 0));
}

}  // namespace

uint16_t LevelScale::level(float x) const {
  if (std::isnan(x)) return not_a_number_level;
  const double level = std::round(steps * std::log2(1 + std::max(double{x}, 0.0) / floor));
  return level < infinite_level ? static_cast<uint16_t>(level) : infinite_level;
}

double LevelScale::radiance(uint16_t level) const {
  return floor * (std::exp2(static_cast<double>(level) / steps) - 1);
}

LevelScale choose_scale(const Image& reference, int steps) {
  const RgbPlanes planes = reference.rgb_planes();
  std::vector<float> luminances;
  for (size_t i = 0; i < reference.pixel_count(); ++i) {
    const float y = luminance(planes[i]);
    if (std::isfinite(y) && y > 0) luminances.push_back(y);
  }
  if (luminances.empty()) return {1.0 / 256, steps};
  const auto middle =
      luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  return {double{*middle} / 256, steps};
}

std::string pack_plane(const std::vector<uint16_t>& values, int width) {
  std::string low, high;
  for (size_t i = 0; i < values.size(); ++i) {
    const auto difference =
        static_cast<uint16_t>(values[i] - predict(values, i, static_cast<size_t>(width)));
    const uint16_t folded = fold_sign(difference);
    low += static_cast<char>(folded & 255);
    high += static_cast<char>(folded >> 8);
  }
  return low + high;
}

std::string encode_picture(const Image& image, const LevelScale& scale) {
  const RgbPlanes planes = image.rgb_planes();
  std::vector<uint16_t> red, green, blue;
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    const uint16_t g = scale.level(planes.g[i]);
    green.push_back(g);
    red.push_back(static_cast<uint16_t>(scale.level(planes.r[i]) - g));
    blue.push_back(static_cast<uint16_t>(scale.level(planes.b[i]) - g));
  }
  const int width = image.width();
  return deflate_bytes(pack_plane(green, width) + pack_plane(red, width) +
                       pack_plane(blue, width));
}

std::string encode_map(std::span<const float> values, int width) {
  std::vector<uint16_t> levels;
  for (const float x : values) {
    levels.push_back(
        std::isnan(x) ? uint16_t{0}
                      : static_cast<uint16_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 63)));
  }
  return deflate_bytes(pack_plane(levels, width));
}

std::string deflate_bytes(const std::string& bytes) {
  // Run lengths: residuals hold few longer repetitions, and looking for those takes a
  // hundred times longer and saves 1 %.
  z_stream stream{};
  constexpr int window_bits = 15, memory_level = 9;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, window_bits, memory_level,
                   Z_RLE) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int code = deflate(&stream, Z_FINISH);
  deflateEnd(&stream);
  if (code != Z_STREAM_END) throw std::runtime_error("zlib cannot compress a picture");
  packed.resize(stream.total_out);
  return packed;
}

}  // namespace tyndall::app
