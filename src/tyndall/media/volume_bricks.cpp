// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/volume_bricks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>

namespace tyndall {
namespace {

// 256 MiB of table: 1.7e10 voxels.
constexpr int64_t max_bricks = int64_t{1} << 25;

// The bricks along one axis; wide numbers, for anything may stand in a file.
struct Axis {
  int64_t first, last;  // active voxels

  int64_t origin() const { return (first - 1) & ~int64_t{BrickGrid::edge - 1}; }
  int64_t count() const { return (last + 1 - origin()) / BrickGrid::edge + 1; }
  float sample(int64_t voxel) const { return static_cast<float>(voxel - origin()); }
};

}  // namespace

BrickLayout lay_out_bricks(Vec3i first, Vec3i last) {
  const Axis x{first.x, last.x}, y{first.y, last.y}, z{first.z, last.z};
  if (x.count() > max_bricks || y.count() > max_bricks || z.count() > max_bricks ||
      x.count() * y.count() > max_bricks || x.count() * y.count() * z.count() > max_bricks)
    throw std::runtime_error(
        fmt::format("the active voxels span {} x {} x {}, more than fits in memory",
                    x.last - x.first + 1, y.last - y.first + 1, z.last - z.first + 1));
  if (std::min({x.origin(), y.origin(), z.origin()}) < INT32_MIN)
    throw std::runtime_error(
        fmt::format("the active voxels begin at ({}, {}, {}), too far from the origin",
                    first.x, first.y, first.z));
  const auto narrow = [](int64_t a, int64_t b, int64_t c) {
    return Vec3i{static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)};
  };
  return {.origin = narrow(x.origin(), y.origin(), z.origin()),
          .brick_count = narrow(x.count(), y.count(), z.count()),
          .box = {{x.sample(x.first - 1), y.sample(y.first - 1), z.sample(z.first - 1)},
                  {x.sample(x.last + 1), y.sample(y.last + 1), z.sample(z.last + 1)}}};
}

PlacedGrid place_bricks(const BrickLayout& layout, const Matrix4& medium_from_voxel,
                        const BrickGrid::Source& source,
                        const BrickGrid::Prepare& prepare) {
  const std::optional<Transform> map = Transform::from_matrix(medium_from_voxel);
  if (!map) throw std::runtime_error("the grid's transform is not invertible");
  const Transform voxel_from_grid = Transform::translate(
      {static_cast<double>(layout.origin.x), static_cast<double>(layout.origin.y),
       static_cast<double>(layout.origin.z)});
  PlacedGrid placed{{*map * voxel_from_grid, layout.box},
                    std::make_shared<BrickGrid>(layout.brick_count, source,
                                                BrickGrid::Precision::compact, prepare)};
  if (placed.grid->is_empty()) placed.box = {};
  return placed;
}

PlacedGrid empty_grid() {
  const auto nothing = [](Vec3i, BrickGrid::Samples) { return false; };
  return {{}, std::make_shared<BrickGrid>(Vec3i{1, 1, 1}, nothing)};
}

}  // namespace tyndall
