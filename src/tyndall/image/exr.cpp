// SPDX-License-Identifier: Apache-2.0
#include <ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "tyndall/image/codec.h"

namespace tyndall {
namespace {

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view bytes) : IStream("EXR"), bytes_(bytes) {}

  bool read(char* to, int n) override {
    const auto count = static_cast<size_t>(n);
    if (position_ > bytes_.size() || count > bytes_.size() - position_) {
      throw std::runtime_error("the file ends too early");
    }
    std::memcpy(to, bytes_.data() + position_, count);
    position_ += count;
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  size_t position_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : OStream("EXR") {}

  void write(const char* from, int n) override {
    const auto count = static_cast<size_t>(n);
    if (position_ + count > bytes_.size()) bytes_.resize(position_ + count);
    std::memcpy(bytes_.data() + position_, from, count);
    position_ += count;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  size_t position_ = 0;
};

Vec2i size_of(const Imath::Box2i& box) {
  const int64_t width = int64_t{box.max.x} - box.min.x + 1;
  const int64_t height = int64_t{box.max.y} - box.min.y + 1;
  check_image_size(width, height);
  return {static_cast<int>(width), static_cast<int>(height)};
}

/// Attributes that say how the file is laid out, which encode_exr() decides anew.
bool describes_layout(const std::string& name) {
  constexpr std::string_view names[] = {"chunkCount",
                                        "maxSamplesPerPixel",
                                        "name",
                                        "pixelAspectRatio",
                                        "screenWindowWidth",
                                        "type",
                                        "version",
                                        "view"};
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

void read_attributes(const Imf::Header& header, Image& image) {
  for (auto it = header.begin(); it != header.end(); ++it) {
    const Imf::Attribute& attribute = it.attribute();
    const std::string name = it.name();
    if (describes_layout(name)) continue;
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
      image.text[name] = text->value();
    } else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) {
      image.numbers[name] = number->value();
    } else if (const auto* real = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) {
      image.numbers[name] = static_cast<float>(real->value());
    } else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
      image.numbers[name] = static_cast<float>(integer->value());
    } else if (const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&attribute)) {
      const float* first = matrix->value().getValue();
      image.matrices[name] = std::vector<float>(first, first + 16);
    }
  }
}

Image empty_image(const Imf::Header& header) {
  const Vec2i size = size_of(header.dataWindow());
  Image image(size.x, size.y);
  const Imath::Box2i& display = header.displayWindow();
  image.full_size = size_of(display);
  image.offset = {header.dataWindow().min.x - display.min.x,
                  header.dataWindow().min.y - display.min.y};
  read_attributes(header, image);
  return image;
}

/// A frame buffer's base address, which belongs to pixel (0, 0) and so may lie outside.
template <typename T>
char* base_address(T* first, const Imath::Box2i& window, size_t width) {
  const auto offset =
      static_cast<std::ptrdiff_t>(window.min.x) +
      static_cast<std::ptrdiff_t>(window.min.y) * static_cast<std::ptrdiff_t>(width);
  return reinterpret_cast<char*>(first) - offset * static_cast<std::ptrdiff_t>(sizeof(T));
}

void read_channels(Imf::InputFile& file, Image& image) {
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  Imf::FrameBuffer buffer;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
      throw std::runtime_error(fmt::format(
          "channel \"{}\" has fewer samples than the image has pixels", it.name()));
    }
    float* first = image.channel(it.name()).values.data();
    const auto width = static_cast<size_t>(image.width());
    buffer.insert(it.name(), Imf::Slice(Imf::FLOAT, base_address(first, window, width),
                                        sizeof(float), sizeof(float) * width));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
}

/// Luminance and subsampled chroma, which OpenEXR turns into R, G, B at half precision.
void read_luminance_chroma(std::string_view bytes, Image& image) {
  MemoryInput input(bytes);
  Imf::RgbaInputFile file(input);
  const Imath::Box2i window = file.dataWindow();
  const auto width = static_cast<size_t>(image.width());
  std::vector<Imf::Rgba> pixels(image.pixel_count());
  const auto offset = window.min.x + window.min.y * static_cast<std::ptrdiff_t>(width);
  file.setFrameBuffer(pixels.data() - offset, 1, width);
  file.readPixels(window.min.y, window.max.y);
  for (const char* name : {"R", "G", "B"}) image.channel(name);
  for (size_t i = 0; i < pixels.size(); ++i) {
    image.find("R")->values[i] = pixels[i].r;
    image.find("G")->values[i] = pixels[i].g;
    image.find("B")->values[i] = pixels[i].b;
  }
}

/// Colours of other primaries become Rec. 709, by way of XYZ.
void convert_primaries(const Imf::Header& header, Image& image) {
  if (!Imf::hasChromaticities(header) || !image.has_rgb()) return;
  const Imf::Chromaticities rec709;
  const Imf::Chromaticities& from = Imf::chromaticities(header);
  const auto differs = [](const Imath::V2f& a, const Imath::V2f& b) {
    return (a - b).length() > 1e-3f;
  };
  if (!differs(from.red, rec709.red) && !differs(from.green, rec709.green) &&
      !differs(from.blue, rec709.blue) && !differs(from.white, rec709.white)) {
    return;
  }
  const Imath::M44f matrix = Imf::RGBtoXYZ(from, 1) * Imf::XYZtoRGB(rec709, 1);
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    float* rgb[3] = {&image.find("R")->values[i], &image.find("G")->values[i],
                     &image.find("B")->values[i]};
    const Imath::V3f converted = Imath::V3f(*rgb[0], *rgb[1], *rgb[2]) * matrix;
    for (int c = 0; c < 3; ++c) *rgb[c] = converted[c];
  }
}

/// Depth, counts and variances need more range or digits than 16 bits have.
bool fits_half(const std::string& name) {
  return !name.starts_with("depth.") && !name.starts_with("spp.") &&
         !name.starts_with("variance.");
}

/// Finite values stay finite.
half to_half(float x) {
  return std::isfinite(x) ? half(std::clamp(x, -float(HALF_MAX), float(HALF_MAX)))
                          : half(x);
}

Imf::Header make_header(const Image& image, bool use_half) {
  const Vec2i full =
      image.full_size.x > 0 ? image.full_size : Vec2i{image.width(), image.height()};
  const Imath::V2i min(image.offset.x, image.offset.y);
  const Imath::Box2i data(min, min + Imath::V2i(image.width() - 1, image.height() - 1));
  Imf::Header header(Imath::Box2i({0, 0}, {full.x - 1, full.y - 1}), data);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());
  for (const auto& [name, value] : image.text)
    header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : image.numbers) {
    if (name == "samplesPerPixel") {  // an integer for pbrt-v4 and its tools
      header.insert(name, Imf::IntAttribute(static_cast<int>(value)));
    } else {
      header.insert(name, Imf::FloatAttribute(value));
    }
  }
  for (const auto& [name, m] : image.matrices) {
    Imath::M44f matrix;
    if (m.size() != 16)
      throw std::runtime_error(fmt::format("matrix \"{}\" is not 4x4", name));
    std::copy(m.begin(), m.end(), matrix.getValue());
    header.insert(name, Imf::M44fAttribute(matrix));
  }
  for (const Channel& channel : image.channels()) {
    const bool as_half = use_half && fits_half(channel.name);
    header.channels().insert(channel.name, Imf::Channel(as_half ? Imf::HALF : Imf::FLOAT));
  }
  return header;
}

/// The argument of Imf::OutputFile for so many threads; its pool has at least as many.
int threads_of_pool(int threads) {
  if (threads == 0) threads = tbb::this_task_arena::max_concurrency();
  if (threads == 1) return 0;  // the caller's own
  if (Imf::globalThreadCount() < threads) Imf::setGlobalThreadCount(threads);
  return threads;
}

}  // namespace

Image decode_exr(std::string_view bytes) {
  MemoryInput input(bytes);
  Imf::InputFile file(input);
  const Imf::ChannelList& channels = file.header().channels();
  Image image = empty_image(file.header());
  if (channels.findChannel("RY") || channels.findChannel("BY")) {
    read_luminance_chroma(bytes, image);
  } else {
    read_channels(file, image);
  }
  if (const Channel* grey = image.find("Y"); grey && !image.has_rgb()) {
    const std::vector<float> values = grey->values;
    for (const char* name : {"R", "G", "B"}) image.channel(name).values = values;
  }
  convert_primaries(file.header(), image);
  return image;
}

std::string encode_exr(const Image& image, bool use_half, int threads) {
  const Imf::Header header = make_header(image, use_half);
  const Imath::Box2i& window = header.dataWindow();
  const auto width = static_cast<size_t>(image.width());
  std::vector<std::vector<half>> halves;
  halves.reserve(image.channels().size());
  Imf::FrameBuffer buffer;
  for (const Channel& channel : image.channels()) {
    if (header.channels()[channel.name].type == Imf::HALF) {
      std::vector<half>& converted = halves.emplace_back(image.pixel_count());
      std::transform(channel.values.begin(), channel.values.end(), converted.begin(),
                     to_half);
      buffer.insert(channel.name,
                    Imf::Slice(Imf::HALF, base_address(converted.data(), window, width),
                               sizeof(half), sizeof(half) * width));
    } else {
      float* first =
          const_cast<float*>(channel.values.data());  // Slice is for reading, too
      buffer.insert(channel.name, Imf::Slice(Imf::FLOAT, base_address(first, window, width),
                                             sizeof(float), sizeof(float) * width));
    }
  }
  MemoryOutput output;
  {
    Imf::OutputFile file(output, header, threads_of_pool(threads));
    file.setFrameBuffer(buffer);
    file.writePixels(image.height());
  }
  return output.take();
}

}  // namespace tyndall
