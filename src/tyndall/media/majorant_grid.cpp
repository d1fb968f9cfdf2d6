// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/majorant_grid.h"

#include <algorithm>

#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

// Samples along a cell: 4 in small grids, then multiples of a brick, so that rays meet few
// cells whatever the resolution.
int choose_edge(Vec3i bricks) {
  const int longest = BrickGrid::edge * std::max({bricks.x, bricks.y, bricks.z});
  if (longest <= 4 * MajorantGrid::max_resolution) return 4;
  const int cell = BrickGrid::edge * MajorantGrid::max_resolution;
  return BrickGrid::edge * ((longest + cell - 1) / cell);
}

}  // namespace

MajorantGrid::MajorantGrid(const BrickGrid& density, float largest) {
  const Vec3i bricks = density.brick_count();
  const Vec3i samples{bricks.x * BrickGrid::edge, bricks.y * BrickGrid::edge,
                      bricks.z * BrickGrid::edge};
  const int edge = choose_edge(bricks);
  edge_ = static_cast<float>(edge);
  resolution_ = {(samples.x + edge - 1) / edge, (samples.y + edge - 1) / edge,
                 (samples.z + edge - 1) / edge};
  cells_.resize(index({0, 0, resolution_.z}));
  const auto fill_row = [&](size_t row) {
    const int y = static_cast<int>(row) % resolution_.y;
    const int z = static_cast<int>(row) / resolution_.y;
    for (int x = 0; x < resolution_.x; ++x) {
      const Vec3i first{x * edge, y * edge, z * edge};
      const Vec3i last{std::min(first.x + edge, samples.x),
                       std::min(first.y + edge, samples.y),
                       std::min(first.z + edge, samples.z)};
      cells_[index({x, y, z})] = MajorantCell::of(density, first, last, largest);
    }
  };
  parallel_for(static_cast<size_t>(resolution_.y) * static_cast<size_t>(resolution_.z),
               fill_row);
}

}  // namespace tyndall
