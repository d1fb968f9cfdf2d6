// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/grid_emission.h"

#include "tyndall/media/blackbody.h"

namespace tyndall {

EmissionLookup::EmissionLookup(const GridEmission& emission,
                               const Transform& world_from_medium)
    : scale_(make_field(emission.scale, world_from_medium)),
      temperature_(make_field(emission.temperature, world_from_medium)),
      temperature_offset_(emission.temperature_offset),
      temperature_scale_(emission.temperature_scale) {}

std::optional<EmissionLookup::Field> EmissionLookup::make_field(
    const std::optional<PlacedGrid>& placed, const Transform& world_from_medium) {
  if (!placed) return std::nullopt;
  return Field{placed->grid, GridPlacement(*placed, world_from_medium)};
}

EmissionLookup EmissionLookup::moved(Vec3d by) const {
  EmissionLookup result = *this;
  for (std::optional<Field>* field : {&result.scale_, &result.temperature_})
    if (*field) (*field)->placement.move(by);
  return result;
}

float EmissionLookup::Field::operator()(Vec3 p) const {
  const Vec3 p_grid = placement.point(p);
  return placement.contains(p_grid) ? grid->interpolate(p_grid) : 0;
}

size_t EmissionLookup::memory() const {
  return (scale_ ? scale_->grid->memory() : 0) +
         (temperature_ ? temperature_->grid->memory() : 0);
}

Rgb EmissionLookup::factor(Vec3 p) const {
  const float scale = scale_ ? (*scale_)(p) : 1;
  if (scale == 0) return Rgb(0);
  if (!temperature_) return Rgb(scale);
  const float kelvin = ((*temperature_)(p)-temperature_offset_) * temperature_scale_;
  return scale * blackbody_radiance(kelvin);
}

}  // namespace tyndall
