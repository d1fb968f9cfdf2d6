// SPDX-License-Identifier: Apache-2.0
//
// Media whose grids stand in a .nvdb or .vdb file: "nanovdb" and, the same, "openvdb".
#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "tyndall/loader/medium_parameters.h"
#include "tyndall/media/volume_file.h"

namespace tyndall::loader {
namespace {

constexpr float coldest_glow = 100;  // black bodies below are black [K]

// What `read` returns; empty, with a report, if the file is not what it should be.
template <typename F>
auto read_or_report(const ParameterSet& parameters, F&& read)
    -> std::optional<decltype(read())> {
  std::string problem;
  try {
    return read();
  } catch (const std::runtime_error& error) {
    problem = error.what();
  }
  parameters.error("filename", fmt::format("cannot read {}", problem));
  return std::nullopt;
}

std::optional<PlacedGrid> read_density(ParameterSet& parameters, const std::string& path) {
  const std::string name = parameters.string("gridname", "density");
  const std::string_view names[] = {name};
  auto placed = read_or_report(parameters, [&] { return read_volume(path, names); });
  if (!placed) return std::nullopt;
  warn_of_rejected(parameters, "filename", "density", placed->grid->rejected());
  if (placed->is_from_level_set)
    parameters.warning(
        "filename",
        "the grid is a level set: the density is one inside its surface, and "
        "fades to zero there");
  warn_if_empty(parameters, "filename", *placed);
  return placed;
}

// The grid that is asked for by name or, if none is, one of the usual names.
std::optional<PlacedGrid> read_temperature(ParameterSet& parameters,
                                           const std::string& path) {
  const bool is_asked_for = parameters.has("temperaturename");
  const std::string name = parameters.string("temperaturename", "");
  const std::string_view names[] = {name};
  if (is_asked_for)
    return read_or_report(parameters, [&] { return read_volume(path, names); });
  if (parameters.has("Le")) return std::nullopt;
  const auto found = read_or_report(
      parameters, [&] { return read_volume_if_any(path, temperature_grid_names); });
  return found.value_or(std::nullopt);
}

GridEmission read_emission(ParameterSet& parameters, const std::string& path) {
  const TemperatureScale kelvin = read_temperature_scale(parameters);
  const std::optional<PlacedGrid> temperature = read_temperature(parameters, path);
  if (!temperature) return {};
  if (parameters.has("Le")) {
    parameters.error("temperaturename",
                     "either \"Le\" or a temperature says how the medium glows");
    return {};
  }
  warn_of_rejected(parameters, "filename", "temperature", temperature->grid->rejected());
  const float hottest = (temperature->grid->maximum() - kelvin.offset) * kelvin.scale;
  if (hottest > coldest_glow)
    return {.scale = {},
            .temperature = temperature,
            .temperature_offset = kelvin.offset,
            .temperature_scale = kelvin.scale};
  parameters.warning(
      "filename",
      fmt::format(
          "the temperature reaches {:.4g} K, too cold to glow; \"temperaturescale\" "
          "multiplies it",
          hottest));
  return {};
}

}  // namespace

std::optional<Medium> make_volume(const MediumContext& in) {
  ParameterSet& p = in.parameters;
  MediumProperties properties = read_properties(in, unit_coefficients);
  const PhaseFunction phase = read_phase_function(p);
  const float Le_scale = p.number("Lescale", 1, not_negative);
  p.ignore({"gridname", "temperaturename", "temperatureoffset", "temperaturecutoff",
            "temperaturescale"});
  const std::string path =
      in.files.find(p.required_string("filename"), p.where("filename"));
  const auto density = read_density(p, path);
  if (!density) return std::nullopt;
  const GridEmission emission = read_emission(p, path);
  if (emission.temperature) properties.Le = Rgb(1);
  properties.Le *= Le_scale;
  const GridMedium medium(*density, in.world_from_medium, properties, phase, emission);
  warn_of_reduced(p, "filename", medium.is_reduced());
  return Medium(medium);
}

}  // namespace tyndall::loader
