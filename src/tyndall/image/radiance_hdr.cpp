// SPDX-License-Identifier: Apache-2.0
// Radiance's picture format [Ward94]: a text header, then scanlines of (r, g, b, exponent).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include "tyndall/image/codec.h"

namespace tyndall {
namespace {

using Rgbe = std::array<uint8_t, 4>;

/// Takes bytes and lines from the front of the file.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  uint8_t byte() {
    if (rest_.empty())
      throw std::runtime_error("the file ends in the middle of its pixels");
    const auto value = static_cast<uint8_t>(rest_[0]);
    rest_.remove_prefix(1);
    return value;
  }
  Rgbe pixel() { return {byte(), byte(), byte(), byte()}; }
  std::string_view line() {
    const size_t n = rest_.find('\n');
    if (n == std::string_view::npos) throw std::runtime_error("the header has no end");
    const std::string_view text = rest_.substr(0, n);
    rest_.remove_prefix(n + 1);
    return text;
  }

 private:
  std::string_view rest_;
};

/// Reads header lines up to the empty one; returns the product of the exposures.
float read_header(Reader& reader) {
  float exposure = 1;
  for (std::string_view line = reader.line(); !line.empty(); line = reader.line()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      throw std::runtime_error(
          fmt::format("unsupported pixel format \"{}\"", line.substr(7, 32)));
    }
    if (!line.starts_with("EXPOSURE=")) continue;
    line.remove_prefix(9);
    while (line.starts_with(' ')) line.remove_prefix(1);
    float factor = 1;
    std::from_chars(line.data(), line.data() + line.size(), factor);
    if (factor > 0) exposure *= factor;
  }
  return exposure;
}

Vec2i read_resolution(Reader& reader) {
  const std::string line(reader.line());
  Vec2i size;
  if (std::sscanf(line.c_str(), "-Y %d +X %d", &size.y, &size.x) != 2) {
    throw std::runtime_error(
        fmt::format("unsupported orientation \"{}\"", line.substr(0, 32)));
  }
  return size;
}

/// One component of all pixels at a time; counts above 128 are runs.
void read_run_length_coded(Reader& reader, std::vector<Rgbe>& row) {
  for (size_t component = 0; component < 4; ++component) {
    for (size_t x = 0; x < row.size();) {
      const uint8_t code = reader.byte();
      const bool is_run = code > 128;
      const size_t count = is_run ? code - 128u : code;
      if (count == 0 || count > row.size() - x) {
        throw std::runtime_error("a run of equal bytes leaves its scanline");
      }
      uint8_t value = 0;
      for (size_t i = 0; i < count; ++i) {
        if (i == 0 || !is_run) value = reader.byte();
        row[x++][component] = value;
      }
    }
  }
}

/// Flat pixels, or the older coding where (1, 1, 1, n) repeats the pixel before.
void read_flat(Reader& reader, Rgbe first, std::vector<Rgbe>& row) {
  int shift = 0;
  for (size_t x = 0; x < row.size();) {
    const Rgbe pixel = x == 0 && shift == 0 ? first : reader.pixel();
    if (x > 0 && pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      const size_t count = std::min<size_t>(size_t{pixel[3]} << shift, row.size() - x);
      std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
      x += count;
      shift = std::min(shift + 8, 24);
    } else {
      row[x++] = pixel;
      shift = 0;
    }
  }
}

void read_row(Reader& reader, std::vector<Rgbe>& row) {
  const Rgbe start = reader.pixel();
  const bool coded = start[0] == 2 && start[1] == 2 &&
                     (size_t{start[2]} << 8 | start[3]) == row.size() && start[2] < 128;
  coded ? read_run_length_coded(reader, row) : read_flat(reader, start, row);
}

Rgb radiance(Rgbe p, float scale) {
  if (p[3] == 0) return {};
  const float factor = std::ldexp(scale, p[3] - (128 + 8));
  return Rgb(p[0], p[1], p[2]) * factor;
}

/// The shared exponent is the largest component's; the mantissas are rounded.
Rgbe rgbe_from(Rgb L) {
  const Rgb safe = clamp_negative(is_finite(L) ? L : Rgb());
  const float largest = max_component(safe);
  if (largest < 1e-32f) return {0, 0, 0, 0};
  int exponent;
  std::frexp(largest, &exponent);
  if (std::round(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;
  exponent = std::min(exponent, 127);
  const auto mantissa = [&](float x) {
    return static_cast<uint8_t>(std::min(std::round(std::ldexp(x, 8 - exponent)), 255.0f));
  };
  return {mantissa(safe.r), mantissa(safe.g), mantissa(safe.b),
          static_cast<uint8_t>(exponent + 128)};
}

}  // namespace

Image decode_hdr(std::string_view bytes) {
  Reader reader(bytes);
  const float exposure = read_header(reader);
  const Vec2i size = read_resolution(reader);
  check_image_size(size.x, size.y);
  Image image(size.x, size.y);
  std::vector<Rgbe> row(static_cast<size_t>(size.x));
  for (const char* name : {"R", "G", "B"}) image.channel(name);
  std::vector<float>& r = image.find("R")->values;
  std::vector<float>& g = image.find("G")->values;
  std::vector<float>& b = image.find("B")->values;
  for (int y = 0; y < size.y; ++y) {
    read_row(reader, row);
    for (int x = 0; x < size.x; ++x) {
      const Rgb L = radiance(row[static_cast<size_t>(x)], 1 / exposure);
      const size_t i = image.index(x, y);
      r[i] = L.r, g[i] = L.g, b[i] = L.b;
    }
  }
  return image;
}

std::string encode_hdr(const Image& image) {
  std::string bytes = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n",
                                  image.height(), image.width());
  const RgbPlanes planes = image.rgb_planes();
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    const Rgbe pixel = rgbe_from(planes[i]);
    bytes.append(reinterpret_cast<const char*>(pixel.data()), pixel.size());
  }
  return bytes;
}

}  // namespace tyndall
