// SPDX-License-Identifier: Apache-2.0
//
// Media whose grids stand in the scene file: "uniformgrid" and "rgbgrid".
#include <fmt/format.h>

#include <utility>

#include "tyndall/loader/color_space.h"
#include "tyndall/loader/medium_parameters.h"

namespace tyndall::loader {
namespace {

// One number, which scales Le, or a grid of its own.
void read_emission_scale(const MediumContext& in, Vec3i n, const Bounds3& box,
                         MediumProperties& properties, GridEmission& emission) {
  ParameterSet& p = in.parameters;
  const Parameter* given = p.find("Lescale", {ParameterType::number});
  if (!given) return;
  if (given->numbers.size() == 1) {
    properties.Le *= p.number("Lescale", 1, not_negative);
  } else if (const auto grid = read_grid(p, "Lescale", n)) {
    emission.scale = place_in_box(*grid, box);
  }
}

void read_temperature(const MediumContext& in, Vec3i n, const Bounds3& box,
                      MediumProperties& properties, GridEmission& emission) {
  ParameterSet& p = in.parameters;
  const TemperatureScale kelvin = read_temperature_scale(p);
  const auto grid = read_grid(p, "temperature", n);
  if (!grid) return;
  if (p.has("Le")) {
    p.error("temperature", "either \"Le\" or \"temperature\" says how the medium glows");
    return;
  }
  properties.Le = Rgb(1);
  emission.temperature = place_in_box(*grid, box);
  emission.temperature_offset = kelvin.offset;
  emission.temperature_scale = kelvin.scale;
}

// A list of colors, converted to linear sRGB. Empty if it is not given or not usable.
std::optional<RgbGrid> read_rgb_grid(ParameterSet& parameters, std::string_view name,
                                     Vec3i n) {
  const Parameter* given = parameters.find(name, {ParameterType::rgb});
  if (!given) return std::nullopt;
  const std::vector<float>& v = given->numbers;
  const size_t expected =
      static_cast<size_t>(n.x) * static_cast<size_t>(n.y) * static_cast<size_t>(n.z);
  if (v.size() != 3 * expected) {
    parameters.error(
        name,
        fmt::format(
            "3 nx * ny * nz = 3 * {} * {} * {} = {} values of \"{}\" expected, got {}", n.x,
            n.y, n.z, 3 * expected, name, v.size()));
    return std::nullopt;
  }
  RgbGrid grid{n, {}};
  grid.values.reserve(expected);
  for (size_t i = 0; i < v.size(); i += 3) {
    const Rgb color{v[i], v[i + 1], v[i + 2]};
    if (!(min_component(color) >= 0)) {
      parameters.error(name, fmt::format("color {} of \"{}\" must not be negative, got {} "
                                         "{} {}",
                                         i / 3, name, color.r, color.g, color.b));
      return std::nullopt;
    }
    grid.values.push_back(clamp_negative(rec709_from(given->color_space, color)));
  }
  return grid;
}

}  // namespace

std::optional<Medium> make_uniform_grid(const MediumContext& in) {
  ParameterSet& p = in.parameters;
  MediumProperties properties = read_properties(in, unit_coefficients);
  const Vec3i n = read_resolution(p);
  const Bounds3 box = read_box(p);
  const PhaseFunction phase = read_phase_function(p);
  GridEmission emission;
  read_temperature(in, n, box, properties, emission);
  read_emission_scale(in, n, box, properties, emission);
  if (!p.has("density")) p.error("density", "parameter \"float density\" is missing");
  const auto density = read_grid(p, "density", n);
  if (!density) return std::nullopt;
  const PlacedGrid placed = place_in_box(*density, box);
  warn_if_empty(p, "density", placed);
  const GridMedium medium(placed, in.world_from_medium, properties, phase, emission);
  warn_of_reduced(p, "density", medium.is_reduced());
  return Medium(medium);
}

std::optional<Medium> make_rgb_grid(const MediumContext& in) {
  ParameterSet& p = in.parameters;
  const Vec3i n = read_resolution(p);
  const Bounds3 box = read_box(p);
  const PhaseFunction phase = read_phase_function(p);
  const float scale = p.number("scale", 1, not_negative);
  const float Le_scale = p.number("Lescale", 1, not_negative);
  const bool has_sigma_a = p.has("sigma_a");
  if (!has_sigma_a && !p.has("sigma_s"))
    p.error("sigma_a", "parameter \"rgb sigma_a\" or \"rgb sigma_s\" is missing");
  else if (!has_sigma_a && p.has("Le"))
    p.error("Le", "only a medium with \"rgb sigma_a\" can have \"Le\"");
  RgbGridMedium::Grids grids{.sigma_a = read_rgb_grid(p, "sigma_a", n),
                             .sigma_s = read_rgb_grid(p, "sigma_s", n),
                             .Le = read_rgb_grid(p, "Le", n)};
  if (!grids.sigma_a && !grids.sigma_s) return std::nullopt;
  const RgbGridMedium medium(grids, box, in.world_from_medium, scale, Le_scale, phase);
  warn_of_reduced(p, grids.sigma_a ? "sigma_a" : "sigma_s", medium.is_reduced());
  return Medium(medium);
}

}  // namespace tyndall::loader
