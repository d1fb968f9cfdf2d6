// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/image.h"

#include <algorithm>
#include <cassert>

namespace tyndall {

std::string channel_name(const std::string& layer, std::string_view component) {
  std::string name = layer;
  if (!layer.empty()) name += '.';
  return name += component;
}

Channel& Image::channel(const std::string& name) {
  if (Channel* found = find(name)) return *found;
  return channels_.emplace_back(Channel{name, std::vector<float>(pixel_count())});
}

const Channel* Image::find(std::string_view name) const {
  const auto it = std::find_if(channels_.begin(), channels_.end(),
                               [&](const Channel& c) { return c.name == name; });
  return it == channels_.end() ? nullptr : &*it;
}

Channel* Image::find(std::string_view name) {
  return const_cast<Channel*>(static_cast<const Image*>(this)->find(name));
}

Rgb Image::rgb(int x, int y, const std::string& layer) const {
  assert(0 <= x && x < width_ && 0 <= y && y < height_);
  return rgb_planes(layer)[index(x, y)];
}

void Image::set_rgb(int x, int y, Rgb value, const std::string& layer) {
  assert(0 <= x && x < width_ && 0 <= y && y < height_);
  channel(channel_name(layer, "R")).values[index(x, y)] = value.r;
  channel(channel_name(layer, "G")).values[index(x, y)] = value.g;
  channel(channel_name(layer, "B")).values[index(x, y)] = value.b;
}

bool Image::has_rgb(const std::string& layer) const {
  return find(channel_name(layer, "R")) && find(channel_name(layer, "G")) &&
         find(channel_name(layer, "B"));
}

RgbPlanes Image::rgb_planes(const std::string& layer) const {
  assert(has_rgb(layer));
  return {find(channel_name(layer, "R"))->values.data(),
          find(channel_name(layer, "G"))->values.data(),
          find(channel_name(layer, "B"))->values.data()};
}

}  // namespace tyndall
