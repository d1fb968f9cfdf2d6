// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/placed_grid.h"

#include <optional>
#include <utility>

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
  auto grid = std::make_shared<BrickGrid>(BrickGrid::from_dense(values));
  const bool is_empty = grid->is_empty();
  return {is_empty ? GridPlace{} : place_in_box(values.resolution, bounds),
          std::move(grid)};
}

GridPlace place_in_box(Vec3i resolution, const Bounds3& bounds) {
  const std::optional<Transform> map = grid_from_medium(bounds, resolution);
  if (!map) return {};
  const Vec3i n = resolution;
  return {map->inverse(),
          {{0.5f, 0.5f, 0.5f},
           {static_cast<float>(n.x) + 0.5f, static_cast<float>(n.y) + 0.5f,
            static_cast<float>(n.z) + 0.5f}}};
}

}  // namespace tyndall
