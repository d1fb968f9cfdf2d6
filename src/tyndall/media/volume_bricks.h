// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "tyndall/math/transform.h"
#include "tyndall/math/vec.h"
#include "tyndall/media/brick_grid.h"
#include "tyndall/media/placed_grid.h"

namespace tyndall {

/// What a voxel's number means as a density. In a level set it is the distance to a
/// surface, negative inside: the density there is one, and falls to zero at the surface
/// within the band of active voxels, as `openvdb::tools::sdfToFogVolume` has it.
class DensityCode {
 public:
  /// Of a grid that holds densities: inactive voxels count as zero.
  DensityCode() = default;
  /// Of a level set with a band of this half width [units of its numbers].
  static DensityCode level_set(float half_width) {
    DensityCode code;
    code.densities_per_unit_ = -1 / half_width;
    return code;
  }

  bool is_level_set() const { return densities_per_unit_ != 0; }
  float operator()(float number, bool is_active) const {
    if (!is_level_set()) return is_active ? number : 0;
    return std::clamp(number * densities_per_unit_, 0.0f, 1.0f);
  }

 private:
  float densities_per_unit_ = 0;
};

/// Where the bricks of a sparse volume lie: aligned with its blocks of 8^3 voxels, and one
/// voxel larger than the active ones on all sides, for the interpolant to fade to zero.
struct BrickLayout {
  Vec3i origin;  ///< voxel at sample (0, 0, 0); a multiple of eight
  Vec3i brick_count;
  Bounds3 box;  ///< in sample coordinates
};

/// The layout for active voxels in [first, last].
/// Throws std::runtime_error if their box is too large for a table of its bricks.
BrickLayout lay_out_bricks(Vec3i first, Vec3i last);

/// Builds the grid, a compact one. Throws std::runtime_error if the transform is not
/// invertible.
PlacedGrid place_bricks(const BrickLayout& layout, const Matrix4& medium_from_voxel,
                        const BrickGrid::Source& source,
                        const BrickGrid::Prepare& prepare = {});

/// A grid without samples.
PlacedGrid empty_grid();

/// Fills a brick from the 2^3 blocks of voxels that it touches. block_at(Vec3i voxel)
/// returns a block: is_zero(), and value(i) of voxel i = (x & 7) << 6 | (y & 7) << 3 | (z &
/// 7), zero if inactive. Returns false if all blocks are zero.
template <typename BlockAt>
bool fill_brick(const BrickLayout& layout, Vec3i brick, BrickGrid::Samples samples,
                BlockAt&& block_at) {
  constexpr int edge = BrickGrid::edge, side = BrickGrid::side;
  const Vec3i start{layout.origin.x + brick.x * edge, layout.origin.y + brick.y * edge,
                    layout.origin.z + brick.z * edge};
  bool is_zero = true;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2 & 1;
    const auto block =
        block_at(Vec3i{start.x + dx * edge, start.y + dy * edge, start.z + dz * edge});
    if (block.is_zero()) continue;
    if (is_zero) std::fill(samples.begin(), samples.end(), 0.0f);
    is_zero = false;
    for (int z = 0; z < (dz ? 1 : edge); ++z)
      for (int y = 0; y < (dy ? 1 : edge); ++y)
        for (int x = 0; x < (dx ? 1 : edge); ++x) {
          const int at = ((z + dz * edge) * side + y + dy * edge) * side + x + dx * edge;
          samples[static_cast<size_t>(at)] = block.value(x << 6 | y << 3 | z);
        }
  }
  return !is_zero;
}

}  // namespace tyndall
