// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/image_conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

#include "apps/tyndall/exit_code.h"
#include "tyndall/image/false_color.h"
#include "tyndall/image/flip.h"
#include "tyndall/image/metrics.h"

namespace tyndall::app {

namespace {

using Names = std::array<std::string, 3>;

/// An image without channels that stands where `image` stands.
Image like(const Image& image) {
  Image result(image.width(), image.height());
  result.offset = image.offset;
  result.full_size = image.full_size;
  result.text = image.text;
  result.numbers = image.numbers;
  result.matrices = image.matrices;
  return result;
}

Image take(const Image& image, const Names& names) {
  Image result = like(image);
  const Names rgb = {"R", "G", "B"};
  for (size_t i = 0; i < 3; ++i)
    result.channel(rgb[i]).values = image.find(names[i])->values;
  return result;
}

bool has_all(const Image& image, const Names& names) {
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string& name) { return image.find(name) != nullptr; });
}

std::string layer_names(const Image& image) {
  std::set<std::string> names;
  for (const Channel& channel : image.channels()) {
    const size_t dot = channel.name.rfind('.');
    names.insert(dot == std::string::npos ? channel.name : channel.name.substr(0, dot));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

Image grey_image(const Image& place, const std::vector<float>& values) {
  Image result = like(place);
  for (const char* name : {"R", "G", "B"}) result.channel(name).values = values;
  return result;
}

std::vector<float> channel_means(const Image& image) {
  const RgbPlanes planes = image.rgb_planes();
  std::vector<float> means(image.pixel_count());
  for (size_t i = 0; i < means.size(); ++i) means[i] = average(planes[i]);
  return means;
}

Image difference(const Image& image, const Image& reference, bool absolute) {
  check_comparable(image, reference);
  Image result = like(image);
  for (const char* name : {"R", "G", "B"}) {
    std::vector<float> values = image.find(name)->values;
    const std::vector<float>& subtracted = reference.find(name)->values;
    for (size_t i = 0; i < values.size(); ++i) {
      values[i] -= subtracted[i];
      if (absolute) values[i] = std::abs(values[i]);
    }
    result.channel(name).values = values;
  }
  return absolute ? grey_image(image, channel_means(result)) : result;
}

ValueRange choose_range(const std::vector<float>& values) {
  std::vector<float> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](float x) { return std::isfinite(x); });
  if (finite.empty()) return {0, 1};
  std::sort(finite.begin(), finite.end());
  const auto rank = static_cast<size_t>(0.999 * static_cast<double>(finite.size() - 1));
  return {std::min(finite.front(), 0.0f), finite[rank]};
}

}  // namespace

ErrorKind parse_error_kind(const std::string& name) {
  if (name == "difference") return ErrorKind::difference;
  if (name == "absolute") return ErrorKind::absolute;
  if (name == "relative") return ErrorKind::relative;
  if (name == "flip") return ErrorKind::flip;
  if (name == "hdr-flip") return ErrorKind::hdr_flip;
  throw std::invalid_argument(fmt::format(
      "must be one of difference, absolute, relative, flip, hdr-flip, got '{}'", name));
}

Image select_layer(const Image& image, const std::string& layer) {
  const Names rgb = {channel_name(layer, "R"), channel_name(layer, "G"),
                     channel_name(layer, "B")};
  const Names xyz = {channel_name(layer, "X"), channel_name(layer, "Y"),
                     channel_name(layer, "Z")};
  if (has_all(image, rgb)) return take(image, rgb);
  if (has_all(image, xyz)) return take(image, xyz);
  for (const std::string& name : {layer, layer + ".Y", layer + ".Z"}) {
    if (image.find(name)) return take(image, {name, name, name});
  }
  throw std::invalid_argument(
      fmt::format("there is no layer \"{}\"; there are {}", layer, layer_names(image)));
}

Image crop_image(const Image& image, const CropWindow& window) {
  const auto [low, high] = window.pixels({image.width(), image.height()});
  const Vec2i min{std::max(low.x, 0), std::max(low.y, 0)};
  const Vec2i max{std::min(high.x, image.width()), std::min(high.y, image.height())};
  if (min.x >= max.x || min.y >= max.y) {
    throw UsageError(fmt::format("the crop window holds no pixel of the {} x {} image",
                                 image.width(), image.height()));
  }
  Image result(max.x - min.x, max.y - min.y);
  for (const Channel& channel : image.channels()) {
    std::vector<float>& values = result.channel(channel.name).values;
    for (int y = 0; y < result.height(); ++y) {
      const float* row = channel.values.data() + image.index(min.x, min.y + y);
      std::copy(row, row + result.width(), values.data() + result.index(0, y));
    }
  }
  result.text = image.text;
  result.numbers = image.numbers;
  result.matrices = image.matrices;
  result.offset = image.offset + min;
  const bool whole = image.full_size == Vec2i{0, 0};
  result.full_size = whole ? Vec2i{image.width(), image.height()} : image.full_size;
  return result;
}

Image expose_image(Image image, float stops) {
  for (const char* name : {"R", "G", "B", "variance.R", "variance.G", "variance.B"}) {
    Channel* channel = image.find(name);
    if (!channel) continue;
    const float factor = std::exp2(channel->name.size() == 1 ? stops : 2 * stops);
    for (float& value : channel->values) value *= factor;
  }
  return image;
}

Image error_image(const Image& image, const Image& reference, ErrorKind kind) {
  check_comparable(image, reference);
  switch (kind) {
    case ErrorKind::difference:
      return difference(image, reference, false);
    case ErrorKind::absolute:
      return difference(image, reference, true);
    case ErrorKind::relative:
      return grey_image(image, relative_square_errors(image, reference, 0.01));
    case ErrorKind::flip:
      return grey_image(image, ldr_flip(image, reference));
    case ErrorKind::hdr_flip:
      break;
  }
  return grey_image(image, hdr_flip(image, reference));
}

Image split_image(const Image& left, const Image& right) {
  check_comparable(right, left);
  Image result = take(left, {"R", "G", "B"});
  for (int y = 0; y < left.height(); ++y) {
    for (int x = left.width() / 2; x < left.width(); ++x) {
      result.set_rgb(x, y, right.rgb(x, y));
    }
  }
  return result;
}

Image to_false_color(const Image& image, std::optional<ValueRange>& range) {
  const std::vector<float> values = channel_means(image);
  if (!range) range = choose_range(values);
  return false_color_image(values, image.width(), image.height(), range->low, range->high);
}

}  // namespace tyndall::app
