// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <cstdint>
#include <stdexcept>

#include "tyndall/image/codec.h"

namespace tyndall {
namespace {

/// libpng's simplified interface, freed at the end of the scope.
class PngImage {
 public:
  PngImage() { control_.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&control_); }

  png_image* operator->() { return &control_; }
  png_image* get() { return &control_; }
  /// Throws libpng's message unless `ok`.
  void check(int ok) const {
    if (!ok) throw std::runtime_error(control_.message);
  }

 private:
  png_image control_{};
};

template <typename Sample>
std::vector<Sample> read_samples(PngImage& png, uint32_t format) {
  png->format = format;
  const size_t size = size_t{png->width} * png->height * PNG_IMAGE_PIXEL_CHANNELS(format);
  std::vector<Sample> samples(size);
  png.check(png_image_finish_read(png.get(), nullptr, samples.data(), 0, nullptr));
  return samples;
}

/// Spreads interleaved samples (r, g, b and perhaps alpha) over the channels.
template <typename Sample, typename Convert>
void fill(Image& image, const std::vector<Sample>& samples, size_t stride,
          Convert convert) {
  const char* names[] = {"R", "G", "B"};
  for (size_t c = 0; c < 3; ++c) {
    std::vector<float>& values = image.channel(names[c]).values;
    for (size_t i = 0; i < values.size(); ++i) values[i] = convert(samples[i * stride + c]);
  }
  if (stride < 4) return;
  constexpr float scale = sizeof(Sample) == 1 ? 1 / 255.0f : 1 / 65535.0f;
  std::vector<float>& alpha = image.channel("A").values;
  for (size_t i = 0; i < alpha.size(); ++i) {
    alpha[i] = static_cast<float>(samples[i * stride + 3]) * scale;
  }
}

/// libpng multiplies linear samples by alpha; take that back.
void divide_by_alpha(Image& image) {
  const Channel* alpha = image.find("A");
  if (!alpha) return;
  for (const char* name : {"R", "G", "B"}) {
    std::vector<float>& values = image.find(name)->values;
    for (size_t i = 0; i < values.size(); ++i) {
      values[i] = safe_divide(values[i], alpha->values[i]);
    }
  }
}

}  // namespace

Image decode_png(std::string_view bytes) {
  PngImage png;
  png.check(png_image_begin_read_from_memory(png.get(), bytes.data(), bytes.size()));
  check_image_size(png->width, png->height);
  Image image(static_cast<int>(png->width), static_cast<int>(png->height));
  const bool has_alpha = (png->format & PNG_FORMAT_FLAG_ALPHA) != 0;
  const size_t stride = has_alpha ? 4 : 3;
  if (png->format & PNG_FORMAT_FLAG_LINEAR) {  // 16 bits per sample
    const uint32_t format =
        has_alpha ? PNG_FORMAT_LINEAR_RGB_ALPHA : uint32_t{PNG_FORMAT_LINEAR_RGB};
    fill(image, read_samples<uint16_t>(png, format), stride,
         [](uint16_t value) { return static_cast<float>(value) / 65535; });
    divide_by_alpha(image);
  } else {
    fill(image, read_samples<uint8_t>(png, has_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB),
         stride, linear_from_srgb8);
  }
  return image;
}

std::string encode_png(const Image& image, const ToneMapping& tone) {
  const std::vector<uint8_t> pixels = srgb8_from_image(image, tone);
  PngImage png;
  png->width = static_cast<uint32_t>(image.width());
  png->height = static_cast<uint32_t>(image.height());
  png->format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(*png.get());
  std::string bytes(size, '\0');
  png.check(png_image_write_to_memory(png.get(), bytes.data(), &size, 0, pixels.data(), 0,
                                      nullptr));
  bytes.resize(size);
  return bytes;
}

}  // namespace tyndall
