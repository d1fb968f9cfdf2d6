// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/volume_bricks.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <stdexcept>

namespace tyndall {
namespace {

// 256 MiB of table: 3.4e10 voxels.
constexpr int64_t max_bricks = int64_t{1} << 26;

constexpr int floor_to_brick(int64_t voxel) {
  return static_cast<int>(voxel & ~int64_t{BrickGrid::edge - 1});
}

}  // namespace

BrickLayout lay_out_bricks(Vec3i first, Vec3i last) {
  const auto extent = [](int a, int b) { return int64_t{b} - a + 1; };
  const Vec3i origin{floor_to_brick(int64_t{first.x} - 1), floor_to_brick(int64_t{first.y} - 1),
                     floor_to_brick(int64_t{first.z} - 1)};
  const auto count = [](int from, int to) { return (int64_t{to} + 1 - from) / BrickGrid::edge + 1; };
  const int64_t nx = count(origin.x, last.x), ny = count(origin.y, last.y),
                nz = count(origin.z, last.z);
  if (nx > max_bricks || ny > max_bricks || nz > max_bricks || nx * ny > max_bricks ||
      nx * ny * nz > max_bricks)
    throw std::runtime_error(fmt::format(
        "the active voxels span {} x {} x {}, more than fits in memory",
        extent(first.x, last.x), extent(first.y, last.y), extent(first.z, last.z)));
  const auto vec = [&](Vec3i v, int by) {
    return Vec3{static_cast<float>(v.x - origin.x + by), static_cast<float>(v.y - origin.y + by),
                static_cast<float>(v.z - origin.z + by)};
  };
  return {.origin = origin,
          .brick_count = {static_cast<int>(nx), static_cast<int>(ny), static_cast<int>(nz)},
          .box = {vec(first, -1), vec(last, 1)}};
}

PlacedGrid place_bricks(const BrickLayout& layout, const Matrix4& medium_from_voxel,
                        const BrickGrid::Source& source) {
  const std::optional<Transform> map = Transform::from_matrix(medium_from_voxel);
  if (!map) throw std::runtime_error("the grid's transform is not invertible");
  PlacedGrid placed{
      .grid = std::make_shared<BrickGrid>(layout.brick_count, source),
      .medium_from_grid = *map * Transform::translate({static_cast<float>(layout.origin.x),
                                                       static_cast<float>(layout.origin.y),
                                                       static_cast<float>(layout.origin.z)}),
      .box = layout.box};
  if (placed.grid->is_empty()) placed.box = {};
  return placed;
}

PlacedGrid empty_grid() {
  const auto nothing = [](Vec3i, BrickGrid::Samples) { return false; };
  return {std::make_shared<BrickGrid>(Vec3i{1, 1, 1}, nothing), {}, {}};
}

}  // namespace tyndall
