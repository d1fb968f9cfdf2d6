// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/math/rgb.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// A named plane of float samples; EXR naming: "R", "variance.R", "depth.Z".
struct Channel {
  std::string name;
  std::vector<float> values;  ///< (height, width), row 0 on top
};

/// The three planes of a colour layer; valid until a channel is added to the image.
struct RgbPlanes {
  const float *r, *g, *b;

  Rgb operator[](size_t pixel) const { return {r[pixel], g[pixel], b[pixel]}; }
};

/// An image of any number of channels, all of one size.
class Image {
 public:
  Image() = default;
  Image(int width, int height) : width_(width), height_(height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  size_t pixel_count() const {
    return static_cast<size_t>(width_) * static_cast<size_t>(height_);
  }

  const std::vector<Channel>& channels() const { return channels_; }
  /// Adds a plane of zeros, or returns the one of that name. Adding ends the life of
  /// references to other channels.
  Channel& channel(const std::string& name);
  /// Null if there is none.
  const Channel* find(std::string_view name) const;
  Channel* find(std::string_view name);

  /// The R, G, B of `layer` ("" for the main one). Precondition: the channels exist.
  Rgb rgb(int x, int y, const std::string& layer = "") const;
  /// Adds the three channels if they are missing.
  void set_rgb(int x, int y, Rgb value, const std::string& layer = "");
  bool has_rgb(const std::string& layer = "") const;
  /// For loops over all pixels; row-major, row 0 on top. Precondition: the channels exist.
  RgbPlanes rgb_planes(const std::string& layer = "") const;
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  /// Where the pixels lie in the full picture (EXR dataWindow and displayWindow).
  Vec2i offset{0, 0};
  Vec2i full_size{0, 0};  ///< zero: the same as the image
  /// Text, number and matrix attributes by name, as EXR stores them.
  std::map<std::string, std::string> text;
  std::map<std::string, float> numbers;
  /// 16 values, row by row, in EXR's convention: row vectors, so translation is in the last
  /// row.
  std::map<std::string, std::vector<float>> matrices;

 private:
  int width_ = 0, height_ = 0;
  std::vector<Channel> channels_;
};

/// "variance", "R" -> "variance.R"; "", "R" -> "R".
std::string channel_name(const std::string& layer, std::string_view component);

}  // namespace tyndall
