// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/placed_grid.h"

#include <optional>

namespace tyndall {
namespace {

// Cell centre x of [0, n] is the sample x + 1/2 of the grid, whose sample 0 is a border of
// zeros.
std::optional<Transform> grid_from_medium(const Bounds3& bounds, Vec3i resolution) {
  const Vec3 size = bounds.diagonal();
  if (!(size.x > 0 && size.y > 0 && size.z > 0) || !is_finite(size)) return std::nullopt;
  const Vec3 n{static_cast<float>(resolution.x), static_cast<float>(resolution.y),
               static_cast<float>(resolution.z)};
  const Vec3 scale{n.x / size.x, n.y / size.y, n.z / size.z};
  Matrix4 m{};
  for (int i = 0; i < 3; ++i) {
    m[static_cast<size_t>(i)][static_cast<size_t>(i)] = scale[i];
    m[static_cast<size_t>(i)][3] = 0.5f - bounds.min[i] * scale[i];
  }
  m[3][3] = 1;
  return Transform::from_matrix(m);
}

}  // namespace

PlacedGrid place_in_box(const DensityGrid& values, const Bounds3& bounds) {
  PlacedGrid placed{std::make_shared<BrickGrid>(BrickGrid::from_dense(values)), {}, {}};
  const auto map = grid_from_medium(bounds, values.resolution);
  if (!map || placed.grid->is_empty()) return placed;
  placed.medium_from_grid = map->inverse();
  const Vec3i n = values.resolution;
  placed.box = {{0.5f, 0.5f, 0.5f},
                {static_cast<float>(n.x) + 0.5f, static_cast<float>(n.y) + 0.5f,
                 static_cast<float>(n.z) + 0.5f}};
  return placed;
}

}  // namespace tyndall
