// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tyndall/math/vec.h"

namespace tyndall {

/// Pixels of a rectangle that lie `stride` apart, in tiles of 8 x 8 of them.
class PixelLattice {
 public:
  enum class Tiles {
    in_rows,
    scattered,  ///< the first so many are spread over the picture
  };

  /// `max` is exclusive. Without pixels that a lattice of twice the stride has, unless this
  /// is the `is_coarsest` one.
  PixelLattice(Vec2i min, Vec2i max, int stride, bool is_coarsest, Tiles tiles);

  size_t tiles() const { return tiles_; }
  /// Calls visit(pixel) for each pixel of a tile; returns how many there are.
  template <typename Visit>
  int64_t for_pixels(size_t tile, const Visit& visit) const;

 private:
  static constexpr int tile_size = 8;

  Vec2i min_, max_;
  int stride_;
  bool is_coarsest_;
  size_t columns_, tiles_, step_ = 1;  // from a tile to the one that is rendered next
};

/// All pixels, row by row of tiles.
std::vector<PixelLattice> all_pixels(Vec2i min, Vec2i max);
/// Each pixel once, so that those of any first part are spread over the picture as evenly
/// as may be: every 32nd pixel of every 32nd row, then what is missing of every 16th, and
/// so on. Small pictures begin with smaller strides.
std::vector<PixelLattice> pixels_from_coarse_to_fine(Vec2i min, Vec2i max);

template <typename Visit>
int64_t PixelLattice::for_pixels(size_t tile, const Visit& visit) const {
  const size_t place = tile * step_ % tiles_;
  const int size = tile_size * stride_;
  const Vec2i first{min_.x + static_cast<int>(place % columns_) * size,
                    min_.y + static_cast<int>(place / columns_) * size};
  const Vec2i end{std::min(first.x + size, max_.x), std::min(first.y + size, max_.y)};
  int64_t visited = 0;
  for (int y = first.y; y < end.y; y += stride_)
    for (int x = first.x; x < end.x; x += stride_) {
      const auto is_on_coarser = [&] {
        return (x - first.x) / stride_ % 2 == 0 && (y - first.y) / stride_ % 2 == 0;
      };
      if (!is_coarsest_ && is_on_coarser()) continue;
      visit(Vec2i{x, y});
      ++visited;
    }
  return visited;
}

}  // namespace tyndall
