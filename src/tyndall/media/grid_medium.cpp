// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/grid_medium.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

// The shortest way from one sample to the next [scene units].
float sample_distance(const Transform& world_from_grid) {
  return std::min({length(world_from_grid.vector({1, 0, 0})),
                   length(world_from_grid.vector({0, 1, 0})),
                   length(world_from_grid.vector({0, 0, 1}))});
}

}  // namespace

GridMedium::GridMedium(const PlacedGrid& density, const Transform& world_from_medium,
                       const MediumProperties& properties, PhaseFunction phase,
                       const GridEmission& emission)
    : density_(density.grid),
      majorants_(std::make_shared<MajorantGrid>(*density_)),
      box_(density.box),
      properties_(properties),
      sigma_t_(properties.sigma_t()),
      phase_(std::move(phase)) {
  world_from_grid_ = world_from_medium * density.medium_from_grid;
  space_ = GridSpace(world_from_grid_.inverse());
  if (!box_.is_empty()) world_bounds_ = world_from_grid_.bounds(box_);
  constexpr float opaque = 1e12f, many = 64;
  const float unit_depth = max_component(sigma_t_) * sample_distance(world_from_grid_);
  if (unit_depth > 0) {
    largest_ = opaque / unit_depth;
    rough_ = many / max_component(sigma_t_);
  }
  if (!emission.is_constant())
    emission_ = std::make_shared<EmissionLookup>(emission, world_from_medium);
}

GridMedium::GridMedium(const DensityGrid& density, const Bounds3& bounds,
                       const Transform& world_from_medium,
                       const MediumProperties& properties, PhaseFunction phase)
    : GridMedium(place_in_box(density, bounds), world_from_medium, properties,
                 std::move(phase)) {}

void GridMedium::move(Vec3d by) {
  world_from_grid_ = Transform::translate(by) * world_from_grid_;
  space_ = space_.moved(by);
  if (!box_.is_empty()) world_bounds_ = world_from_grid_.bounds(box_);
  if (emission_) emission_ = std::make_shared<EmissionLookup>(emission_->moved(by));
}

void GridMedium::Segments::look_closer(const CellWalk::Step& step) {
  const Vec3i bricks = medium_->density_->brick_count();
  constexpr int edge = BrickGrid::edge;
  among_samples_.emplace(Vec3i{edge * bricks.x, edge * bricks.y, edge * bricks.z}, 1.0f,
                         ray_, step.t_min, step.t_max);
}

bool GridMedium::Segments::next_among_samples(MediumSegment& segment) {
  const BrickGrid& density = *medium_->density_;
  const auto row = static_cast<size_t>(BrickGrid::edge * density.brick_count().x);
  const auto column = static_cast<size_t>(BrickGrid::edge * density.brick_count().y);
  CellWalk::Step step;
  while (among_samples_->next(step)) {
    const Vec3i first{static_cast<int>(step.cell % row),
                      static_cast<int>(step.cell / row % column),
                      static_cast<int>(step.cell / (row * column))};
    const BrickGrid::Range range =
        density.range(first, {first.x + 1, first.y + 1, first.z + 1});
    if (range.max == 0) continue;
    take({range.max * (1 + 1e-6f), range.mean}, step, segment);
    return true;
  }
  among_samples_.reset();
  return false;
}

}  // namespace tyndall
