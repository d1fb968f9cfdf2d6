// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/known_pixels.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace tyndall {
namespace {

constexpr size_t none = std::numeric_limits<size_t>::max();

class KnownPixels {
 public:
  KnownPixels(Vec2i size, const std::function<bool(size_t)>& is_known)
      : size_(size), is_known_(is_known) {
    pixels_.resize(static_cast<size_t>(size.x) * static_cast<size_t>(size.y));
    std::iota(pixels_.begin(), pixels_.end(), size_t{0});
  }

  std::vector<size_t> run() {
    int side = 1;
    while (side < std::max(size_.x, size_.y)) side *= 2;
    visit({0, 0}, side);
    return std::move(pixels_);
  }

 private:
  // Finds pixels for those of a square, unless it has none that is known. Returns the first
  // one.
  size_t visit(Vec2i corner, int side) {
    if (corner.x >= size_.x || corner.y >= size_.y) return none;
    if (side == 1) return is_known_(index(corner)) ? index(corner) : none;
    const int half = side / 2;
    const Vec2i parts[4] = {corner, corner + Vec2i{half, 0}, corner + Vec2i{0, half},
                            corner + Vec2i{half, half}};
    size_t known[4], first = none;
    for (int i = 0; i < 4; ++i) {
      known[i] = visit(parts[i], half);
      if (first == none) first = known[i];
    }
    for (int i = 0; i < 4 && first != none; ++i)
      if (known[i] == none) set(parts[i], half, first);
    return first;
  }

  void set(Vec2i corner, int side, size_t pixel) {
    const int end_x = std::min(corner.x + side, size_.x);
    const int end_y = std::min(corner.y + side, size_.y);
    for (int y = corner.y; y < end_y; ++y)
      for (int x = corner.x; x < end_x; ++x) pixels_[index({x, y})] = pixel;
  }

  size_t index(Vec2i p) const {
    return static_cast<size_t>(p.y) * static_cast<size_t>(size_.x) +
           static_cast<size_t>(p.x);
  }

  Vec2i size_;
  const std::function<bool(size_t)>& is_known_;
  std::vector<size_t> pixels_;
};

}  // namespace

std::vector<size_t> known_pixels(Vec2i size, const std::function<bool(size_t)>& is_known) {
  return KnownPixels(size, is_known).run();
}

}  // namespace tyndall
