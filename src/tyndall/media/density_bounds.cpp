// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/density_bounds.h"

namespace tyndall {
namespace {

Vec3i sample_count(const BrickGrid& density) {
  const Vec3i bricks = density.brick_count();
  return {BrickGrid::edge * bricks.x, BrickGrid::edge * bricks.y,
          BrickGrid::edge * bricks.z};
}

}  // namespace

float opaque_density(float sigma_t, const Transform& world_from_grid) {
  constexpr float opaque = 1e6f;
  const float unit_depth = sigma_t * std::min({length(world_from_grid.vector({1, 0, 0})),
                                               length(world_from_grid.vector({0, 1, 0})),
                                               length(world_from_grid.vector({0, 0, 1}))});
  return unit_depth > 0 ? opaque / unit_depth : infinity;
}

template <size_t channels>
DensityBounds<channels>::DensityBounds(const Densities& densities, float sigma_t,
                                       float largest)
    : densities_(densities), largest_(largest) {
  constexpr float many = 64;
  if (sigma_t > 0) rough_ = many / sigma_t;
  for (size_t c = 0; c < channels; ++c) grids_[c] = MajorantGrid(*densities[c], largest);
}

template <size_t channels>
std::unique_ptr<SampleWalk<channels>> DensityBounds<channels>::look_closer(
    const GridRay& ray, float t_min, float t_max) const {
  return std::make_unique<SampleWalk<channels>>(
      *this, CellWalk(sample_count(*densities_[0]), 1, ray, t_min, t_max));
}

template <size_t channels>
auto DensityBounds<channels>::cell_between_samples(size_t index) const -> Cell {
  const Vec3i n = sample_count(*densities_[0]);
  const auto row = static_cast<size_t>(n.x), column = static_cast<size_t>(n.y);
  const Vec3i first{static_cast<int>(index % row), static_cast<int>(index / row % column),
                    static_cast<int>(index / (row * column))};
  Cell found;
  for (size_t c = 0; c < channels; ++c)
    found[c] = MajorantCell::of(*densities_[c], first,
                                {first.x + 1, first.y + 1, first.z + 1}, largest_);
  return found;
}

template <size_t channels>
size_t DensityBounds<channels>::memory() const {
  size_t sum = 0;
  for (const MajorantGrid& grid : grids_) sum += grid.memory();
  return sum;
}

template <size_t channels>
auto SampleWalk<channels>::next() -> std::optional<Found> {
  CellWalk::Step step;
  while (walk_.next(step)) {
    const typename Bounds::Cell cell = bounds_.cell_between_samples(step.cell);
    if (!Bounds::is_empty(cell)) return Found{step.t_min, step.t_max, cell};
  }
  return std::nullopt;
}

template class SampleWalk<1>;
template class SampleWalk<3>;
template class DensityBounds<1>;
template class DensityBounds<3>;

}  // namespace tyndall
