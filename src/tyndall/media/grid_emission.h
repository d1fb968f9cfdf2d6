// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "tyndall/math/rgb.h"
#include "tyndall/math/vec.h"
#include "tyndall/media/grid_placement.h"
#include "tyndall/media/placed_grid.h"

namespace tyndall {

/// What makes the emission of a grid medium vary. Le is multiplied by the value of `scale`,
/// and by the colour of a black body at (temperature - offset) * temperature_scale [K].
struct GridEmission {
  std::optional<PlacedGrid> scale;        ///< [1]
  std::optional<PlacedGrid> temperature;  ///< times temperature_scale [K]
  float temperature_offset = 0;
  float temperature_scale = 1;

  bool is_constant() const { return !scale && !temperature; }
};

/// GridEmission, ready to be looked up in world space.
class EmissionLookup {
 public:
  EmissionLookup(const GridEmission& emission, const Transform& world_from_medium);

  EmissionLookup moved(Vec3d by) const;  ///< in the world

  /// The factor of Le at a point of world space.
  Rgb factor(Vec3 p) const;
  size_t memory() const;  ///< of the grids [bytes]

 private:
  // A grid that can be looked up in world space.
  struct Field {
    std::shared_ptr<const BrickGrid> grid;
    GridPlacement placement;

    float operator()(Vec3 p) const;
  };
  static std::optional<Field> make_field(const std::optional<PlacedGrid>& placed,
                                         const Transform& world_from_medium);

  std::optional<Field> scale_, temperature_;
  float temperature_offset_, temperature_scale_;
};

}  // namespace tyndall
