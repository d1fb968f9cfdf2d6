// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <bit>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "tyndall/image/codec.h"

namespace tyndall {
namespace {

/// The next word of the header; words are separated by single white space in practice, by
/// any amount in the wild.
std::string_view next_word(std::string_view& rest) {
  while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest[0]))) {
    rest.remove_prefix(1);
  }
  size_t n = 0;
  while (n < rest.size() && !std::isspace(static_cast<unsigned char>(rest[n]))) ++n;
  const std::string_view word = rest.substr(0, n);
  rest.remove_prefix(n);
  return word;
}

template <typename Number>
Number next_number(std::string_view& rest, const char* what) {
  const std::string_view word = next_word(rest);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw std::runtime_error(fmt::format("the PFM header has \"{}\" where its {} belongs",
                                         word.substr(0, 32), what));
  }
  return value;
}

float load_float(const char* bytes, bool little_endian) {
  uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  if (little_endian != (std::endian::native == std::endian::little)) {
    bits = __builtin_bswap32(bits);
  }
  return std::bit_cast<float>(bits);
}

}  // namespace

Image decode_pfm(std::string_view bytes) {
  std::string_view rest = bytes;
  const size_t components = next_word(rest) == "PF" ? 3 : 1;
  const int width = next_number<int>(rest, "width");
  const int height = next_number<int>(rest, "height");
  const bool little_endian = next_number<float>(rest, "scale") < 0;
  check_image_size(width, height);
  if (!rest.empty()) rest.remove_prefix(1);
  Image image(width, height);
  const size_t expected = image.pixel_count() * components * sizeof(float);
  if (rest.size() < expected) {
    throw std::runtime_error(
        fmt::format("the file ends after {} of {} bytes of pixels", rest.size(), expected));
  }
  const char* names[] = {"R", "G", "B"};
  for (size_t c = 0; c < 3; ++c) {
    std::vector<float>& values = image.channel(names[c]).values;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const size_t source = image.index(x, height - 1 - y) * components + c % components;
        values[image.index(x, y)] =
            load_float(rest.data() + source * sizeof(float), little_endian);
      }
    }
  }
  return image;
}

std::string encode_pfm(const Image& image) {
  const bool little = std::endian::native == std::endian::little;
  std::string bytes = fmt::format("PF\n{} {}\n{}\n", image.width(), image.height(),
                                  little ? "-1.0" : "1.0");
  const RgbPlanes planes = image.rgb_planes();
  for (int y = image.height() - 1; y >= 0; --y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb value = planes[image.index(x, y)];
      const float pixel[3] = {value.r, value.g, value.b};
      bytes.append(reinterpret_cast<const char*>(pixel), sizeof pixel);
    }
  }
  return bytes;
}

}  // namespace tyndall
