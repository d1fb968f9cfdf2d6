// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/pixel_sums.h"

#include <algorithm>

#include "tyndall/math/add_relaxed.h"

namespace tyndall {
namespace {

constexpr int max_size = 256;

int block_of(int64_t i, int resolution, int size) {
  return static_cast<int>(std::clamp<int64_t>(i * size / resolution, 0, size - 1));
}

// The first pixel of a block: the least i of which block_of() is this.
int first_pixel(int64_t block, int resolution, int size) {
  return static_cast<int>((block * resolution + size - 1) / size);
}

}  // namespace

PixelSums::PixelSums(Vec2i resolution)
    : resolution_{std::max(resolution.x, 1), std::max(resolution.y, 1)},
      size_{std::min(resolution_.x, max_size), std::min(resolution_.y, max_size)},
      sums_(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y)) {}

void PixelSums::record(Vec2i pixel, int64_t value) const {
  const int x = block_of(pixel.x, resolution_.x, size_.x);
  const int y = block_of(pixel.y, resolution_.y, size_.y);
  Sum& sum =
      sums_[static_cast<size_t>(y) * static_cast<size_t>(size_.x) + static_cast<size_t>(x)];
  add_relaxed(sum.value, value);
  add_relaxed(sum.count, 1);
}

void PixelSums::clear() {
  for (Sum& sum : sums_) sum.value = sum.count = 0;
}

Vec2i PixelSums::pixel(size_t block) const {
  const auto width = static_cast<size_t>(size_.x);
  return {first_pixel(static_cast<int64_t>(block % width), resolution_.x, size_.x),
          first_pixel(static_cast<int64_t>(block / width), resolution_.y, size_.y)};
}

}  // namespace tyndall
