// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "tyndall/loader/files.h"
#include "tyndall/loader/medium_presets.h"
#include "tyndall/loader/parameter_set.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/brick_grid.h"
#include "tyndall/media/medium.h"

namespace tyndall::loader {

/// What a medium is made from.
struct MediumContext {
  ParameterSet& parameters;
  const Transform& world_from_medium;
  const FileFinder& files;
};

/// The coefficients of grids that state none.
inline constexpr MediumPreset unit_coefficients{"", {1, 1, 1}, {1, 1, 1}};

/// sigma_a, sigma_s, preset, scale and Le. `otherwise` are the coefficients that are given
/// neither one by one nor by a preset.
MediumProperties read_properties(const MediumContext& in, const MediumPreset& otherwise);

/// phase, and the parameters of the phase function that it names; "hg" with its g if none.
PhaseFunction read_phase_function(ParameterSet& parameters);

/// nx, ny, nz
Vec3i read_resolution(ParameterSet& parameters);

/// p0 and p1, any two opposite corners. The unit cube, with a report, if it has no volume.
Bounds3 read_box(ParameterSet& parameters);

/// A list of nx * ny * nz floats. Empty if it is not given or, with a report, not usable.
std::optional<DensityGrid> read_grid(ParameterSet& parameters, std::string_view name,
                                     Vec3i resolution);

/// Reports numbers of the grid of `what` that count as zero.
void warn_of_rejected(const ParameterSet& parameters, std::string_view name,
                      std::string_view what, const BrickGrid::Rejected& rejected);

/// Reports a density that is zero everywhere.
void warn_if_empty(const ParameterSet& parameters, std::string_view name,
                   const PlacedGrid& density);

/// Reports a medium whose densities were reduced: GridMedium::is_reduced().
void warn_of_reduced(const ParameterSet& parameters, std::string_view name,
                     bool is_reduced);

/// How a temperature becomes a color: black body at (temperature - offset) * scale [K].
struct TemperatureScale {
  float offset, scale;
};
/// temperatureoffset or, by its other name, temperaturecutoff; and temperaturescale
TemperatureScale read_temperature_scale(ParameterSet& parameters);

// The makers of grids: each reads all parameters of its type. Empty, with a report, if
// nothing sensible is left.
std::optional<Medium> make_uniform_grid(const MediumContext& in);
std::optional<Medium> make_rgb_grid(const MediumContext& in);
std::optional<Medium> make_volume(const MediumContext& in);

}  // namespace tyndall::loader
