// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/grid_medium.h"

#include <utility>

namespace tyndall {

GridMedium::GridMedium(const PlacedGrid& density, const Transform& world_from_medium,
                       const MediumProperties& properties, PhaseFunction phase,
                       const GridEmission& emission)
    : density_(density.grid),
      placement_(density, world_from_medium),
      properties_(properties),
      sigma_t_(properties.sigma_t()),
      phase_(std::move(phase)) {
  const float sigma_t = max_component(sigma_t_);
  largest_ = opaque_density(sigma_t, placement_.world_from_grid());
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
  placement_.move(by);
  if (emission_) emission_ = std::make_shared<EmissionLookup>(emission_->moved(by));
}

}  // namespace tyndall
