// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/grid_medium.h"

#include <cassert>

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

GridMedium::GridMedium(const DensityGrid& density, Bounds3 bounds,
                       const Transform& world_from_medium, MediumProperties properties,
                       PhaseFunction phase)
    : density_(std::make_shared<BrickGrid>(BrickGrid::from_dense(density))),
      majorants_(std::make_shared<MajorantGrid>(*density_)),
      properties_(properties),
      sigma_t_(properties.sigma_t()),
      phase_(std::move(phase)) {
  const auto map = grid_from_medium(bounds, density.resolution);
  if (!map || density_->is_empty()) return;
  space_ = GridSpace(*map * world_from_medium.inverse());
  const Vec3i n = density.resolution;
  box_ = {{0.5f, 0.5f, 0.5f},
          {static_cast<float>(n.x) + 0.5f, static_cast<float>(n.y) + 0.5f,
           static_cast<float>(n.z) + 0.5f}};
  world_bounds_ = world_from_medium.bounds(bounds);
}

}  // namespace tyndall
