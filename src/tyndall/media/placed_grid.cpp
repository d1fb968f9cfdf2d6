// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/placed_grid.h"

#include <optional>

namespace tyndall {
namespace {

// Cell centre x of [0, n] is the sample x + 1/2 of the grid, whose sample 0 is a border of
// zeros.
std::optional<Transform> grid_from_medium(const Bounds3& bounds, Vec3i resolution) {
  const Vec3 rounded = bounds.diagonal();
  if (!(min_component(rounded) > 0) || !is_finite(rounded)) return std::nullopt;
  const Vec3d size = Vec3d(bounds.max) - bounds.min;
  const Transform map = Transform::translate({0.5, 0.5, 0.5}) *
                        Transform::scale({resolution.x / size.x, resolution.y / size.y,
                                          resolution.z / size.z}) *
                        Transform::translate(-Vec3d(bounds.min));
  return map.fits_in_floats() ? std::optional(map) : std::nullopt;
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
