// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "tyndall/image/codec.h"
#include "tyndall/image/whole_file.h"

namespace tyndall {
namespace {

enum class Format { exr, hdr, pfm, png };

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Format format_of_path(const std::string& path) {
  const std::string extension =
      lower_case(std::filesystem::path(path).extension().string());
  if (extension == ".exr") return Format::exr;
  if (extension == ".hdr") return Format::hdr;
  if (extension == ".pfm") return Format::pfm;
  if (extension == ".png") return Format::png;
  throw std::invalid_argument(
      fmt::format("{}: unknown image extension \"{}\"; known are .exr, .hdr, .pfm and .png",
                  path, extension));
}

Image decode(std::string_view bytes) {
  using std::string_view_literals::operator""sv;
  if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return decode_exr(bytes);
  if (bytes.starts_with("\x89PNG"sv)) return decode_png(bytes);
  if (bytes.starts_with("PF"sv) || bytes.starts_with("Pf"sv)) return decode_pfm(bytes);
  if (bytes.starts_with("#?"sv)) return decode_hdr(bytes);
  throw std::runtime_error(bytes.empty() ? "the file is empty"
                                         : "not an EXR, PNG, PFM or Radiance HDR file");
}

std::string encode(const Image& image, Format format, const WriteOptions& options) {
  if (format != Format::exr && !image.has_rgb()) {
    throw std::runtime_error("the image has no R, G and B channels");
  }
  switch (format) {
    case Format::exr:
      return encode_exr(image, options.half, options.threads);
    case Format::hdr:
      return encode_hdr(image);
    case Format::pfm:
      return encode_pfm(image);
    case Format::png:
      break;
  }
  return encode_png(image, options.tone);
}

}  // namespace

void check_image_size(int64_t width, int64_t height) {
  constexpr int64_t most = int64_t{1} << 28;
  if (width < 1 || height < 1 || width > most || height > most || width * height > most) {
    throw std::runtime_error(
        fmt::format("{} x {} pixels; an image has from 1 to 2^28 pixels", width, height));
  }
}

Image read_image(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  try {
    return decode(bytes);
  } catch (const std::exception& e) {
    throw std::runtime_error(fmt::format("{}: cannot read: {}", path, e.what()));
  }
}

void write_image(const Image& image, const std::string& path, const WriteOptions& options) {
  const Format format = format_of_path(path);
  std::string bytes;
  try {
    bytes = encode(image, format, options);
  } catch (const std::exception& e) {
    throw std::runtime_error(fmt::format("{}: cannot write: {}", path, e.what()));
  }
  write_whole_file(path, bytes);
}

void check_writable(const std::string& path) {
  format_of_path(path);
  check_can_write_file(path);
}

}  // namespace tyndall
