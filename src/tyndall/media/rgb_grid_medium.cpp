// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/rgb_grid_medium.h"

#include <cassert>
#include <utility>

#include "tyndall/media/placed_grid.h"

namespace tyndall {
namespace {

RgbGrid scaled(RgbGrid grid, float scale) {
  for (Rgb& v : grid.values) v *= scale;
  return grid;
}

RgbGrid sum(RgbGrid a, const RgbGrid& b) {
  assert(a.resolution == b.resolution);
  for (size_t i = 0; i < a.values.size(); ++i) a.values[i] += b.values[i];
  return a;
}

DensityGrid channel(const RgbGrid& grid, int c) {
  DensityGrid values{grid.resolution, {}};
  values.values.reserve(grid.values.size());
  for (const Rgb& v : grid.values) values.values.push_back(v[c]);
  return values;
}

}  // namespace

std::shared_ptr<const RgbGridMedium::Field> RgbGridMedium::make_field(const RgbGrid& grid) {
  return std::make_shared<Field>(Field{BrickGrid::from_dense(channel(grid, 0)),
                                       BrickGrid::from_dense(channel(grid, 1)),
                                       BrickGrid::from_dense(channel(grid, 2))});
}

RgbGridMedium::RgbGridMedium(const Grids& grids, const Bounds3& bounds,
                             const Transform& world_from_medium, float scale,
                             float Le_scale, PhaseFunction phase)
    : phase_(std::move(phase)) {
  assert(grids.sigma_a || grids.sigma_s);
  const RgbGrid& given = grids.sigma_a ? *grids.sigma_a : *grids.sigma_s;
  const RgbGrid one{given.resolution, std::vector<Rgb>(given.values.size(), Rgb(1))};
  const RgbGrid sigma_a = scaled(grids.sigma_a.value_or(one), scale);
  const RgbGrid sigma_s = scaled(grids.sigma_s.value_or(one), scale);
  sigma_t_ = make_field(sum(sigma_a, sigma_s));
  sigma_s_ = make_field(sigma_s);
  if (grids.Le && Le_scale > 0) Le_ = make_field(scaled(*grids.Le, Le_scale));
  majorants_ = std::make_shared<Majorants>(Majorants{
      MajorantGrid(sigma_t_->r), MajorantGrid(sigma_t_->g), MajorantGrid(sigma_t_->b)});

  // Only for its transform and box: where the samples lie is the same for all of them.
  const DensityGrid ones{given.resolution, std::vector<float>(given.values.size(), 1)};
  const PlacedGrid placed = place_in_box(ones, bounds);
  world_from_grid_ = world_from_medium * placed.medium_from_grid;
  space_ = GridSpace(world_from_grid_.inverse());
  box_ = placed.box;
  if (!box_.is_empty()) world_bounds_ = world_from_grid_.bounds(box_);
}

void RgbGridMedium::move(Vec3d by) {
  world_from_grid_ = Transform::translate(by) * world_from_grid_;
  space_ = space_.moved(by);
  if (!box_.is_empty()) world_bounds_ = world_from_grid_.bounds(box_);
}

}  // namespace tyndall
