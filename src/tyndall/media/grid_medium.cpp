// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/grid_medium.h"

#include <utility>

namespace tyndall {

GridMedium::GridMedium(const PlacedGrid& density, const Transform& world_from_medium,
                       const MediumProperties& properties, PhaseFunction phase,
                       const GridEmission& emission)
    : density_(density.grid),
      box_(density.box),
      properties_(properties),
      sigma_t_(properties.sigma_t()),
      phase_(std::move(phase)) {
  world_from_grid_ = world_from_medium * density.medium_from_grid;
  space_ = GridSpace(world_from_grid_.inverse());
  if (!box_.is_empty()) world_bounds_ = world_from_grid_.bounds(box_);
  const float sigma_t = max_component(sigma_t_);
  largest_ = opaque_density(sigma_t, world_from_grid_);
  bounds_ = std::make_shared<DensityBounds<1>>(DensityBounds<1>::Densities{density_.get()},
                                               sigma_t, largest_);
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

}  // namespace tyndall
