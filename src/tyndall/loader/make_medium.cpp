// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>

#include "tyndall/loader/make_scene_parts.h"
#include "tyndall/loader/medium_presets.h"
#include "tyndall/loader/nearest_name.h"
#include "tyndall/loader/spectrum.h"

namespace tyndall::loader {
namespace {

struct MediumContext {
  ParameterSet& parameters;
  const Transform& world_from_medium;
  const FileFinder& files;
};

constexpr MediumPreset whole_milk{"", {2.55f, 3.21f, 3.77f}, {0.0011f, 0.0024f, 0.014f}};
constexpr MediumPreset unit_coefficients{"", {1, 1, 1}, {1, 1, 1}};

std::optional<MediumPreset> read_preset(ParameterSet& parameters) {
  const std::string name = parameters.string("preset", "");
  if (name.empty()) return std::nullopt;
  std::optional<MediumPreset> preset = medium_preset(name);
  if (!preset)
    parameters.error("preset", fmt::format("there is no preset \"{}\"{}", name,
                                           did_you_mean(name, medium_preset_names())));
  return preset;
}

// sigma_a, sigma_s, preset, scale, Le, and Lescale where it is one number.
MediumProperties read_properties(const MediumContext& in, const MediumPreset& otherwise) {
  ParameterSet& p = in.parameters;
  const std::optional<MediumPreset> preset = read_preset(p);
  const auto coefficient = [&](std::string_view name, Rgb preset_value, Rgb default_value) {
    const auto given = spectrum_parameter(p, name, SpectrumUse::coefficient, in.files);
    return preset ? preset_value : given.value_or(default_value);
  };
  const float scale = p.number("scale", 1, not_negative);
  const Rgb sigma_a =
      coefficient("sigma_a", preset ? preset->sigma_a : Rgb{}, otherwise.sigma_a) * scale;
  const Rgb sigma_s =
      coefficient("sigma_s", preset ? preset->sigma_s : Rgb{}, otherwise.sigma_s) * scale;
  const Rgb Le =
      spectrum_parameter(p, "Le", SpectrumUse::illuminant, in.files).value_or(Rgb{});
  if (is_finite(sigma_a + sigma_s)) return {sigma_a, sigma_s, Le};
  p.error("scale", "the coefficients times \"scale\" are too large");
  return {Rgb{}, Rgb{}, Le};
}

PhaseFunction read_phase_function(ParameterSet& parameters) {
  const float g = parameters.number("g", 0, {-1, 1, true});
  if (g == 0) return IsotropicPhase{};
  return HenyeyGreenstein{g};
}

std::optional<Medium> make_homogeneous(const MediumContext& in) {
  MediumProperties properties = read_properties(in, whole_milk);
  properties.Le *= in.parameters.number("Lescale", 1, not_negative);
  return Medium(HomogeneousMedium(properties, read_phase_function(in.parameters)));
}

// Reports a wrong count, negative values; `values` are then replaced by zeros.
void check_grid(ParameterSet& parameters, std::string_view name, std::vector<float>& values,
                Vec3i n) {
  const size_t expected =
      static_cast<size_t>(n.x) * static_cast<size_t>(n.y) * static_cast<size_t>(n.z);
  if (values.size() != expected) {
    parameters.error(
        name,
        fmt::format("nx * ny * nz = {} * {} * {} = {} values of \"{}\" expected, got {}",
                    n.x, n.y, n.z, expected, name, values.size()));
    values.clear();
    return;
  }
  const auto bad =
      std::find_if(values.begin(), values.end(), [](float x) { return !(x >= 0); });
  if (bad == values.end()) return;
  parameters.error(name, fmt::format("value {} of \"{}\" must not be negative, got {}",
                                     bad - values.begin(), name, *bad));
  values.clear();
}

Vec3i read_resolution(ParameterSet& parameters) {
  constexpr Range side{1, 1 << 16};
  return {parameters.integer("nx", 1, side), parameters.integer("ny", 1, side),
          parameters.integer("nz", 1, side)};
}

Bounds3 read_box(ParameterSet& parameters) {
  const Vec3 p0 = parameters.point3("p0").value_or(Vec3{0, 0, 0});
  const Vec3 p1 = parameters.point3("p1").value_or(Vec3{1, 1, 1});
  if (!(p0.x < p1.x && p0.y < p1.y && p0.z < p1.z)) {
    parameters.error(
        "p1",
        fmt::format("p1 must lie above p0 in x, y and z; got p0 = {} {} {}, p1 = {} {} {}",
                    p0.x, p0.y, p0.z, p1.x, p1.y, p1.z));
    return {{0, 0, 0}, {1, 1, 1}};
  }
  return {p0, p1};
}

// A grid of its own in pbrt-v4; here its mean.
float read_emission_scale(ParameterSet& parameters, Vec3i n) {
  std::vector<float> values = parameters.numbers("Lescale");
  if (values.empty()) return 1;
  check_grid(parameters, "Lescale", values, n);
  if (values.empty()) return 1;
  if (values.size() > 1)
    parameters.unsupported("Lescale",
                           "a grid of \"Lescale\" is not supported yet, its mean is used");
  return std::accumulate(values.begin(), values.end(), 0.0f) /
         static_cast<float>(values.size());
}

std::optional<Medium> make_uniform_grid(const MediumContext& in) {
  ParameterSet& p = in.parameters;
  if (p.has("temperature"))
    p.unsupported("temperature",
                  "temperature is not supported yet, the medium does not glow");
  p.ignore({"temperature", "temperatureoffset", "temperaturecutoff", "temperaturescale"});
  MediumProperties properties = read_properties(in, unit_coefficients);
  const Vec3i n = read_resolution(p);
  const Bounds3 box = read_box(p);
  properties.Le *= read_emission_scale(p, n);
  const PhaseFunction phase = read_phase_function(p);
  if (!p.has("density")) {
    p.error("density", "parameter \"float density\" is missing");
    return std::nullopt;
  }
  std::vector<float> density = p.numbers("density");
  check_grid(p, "density", density, n);
  if (density.empty()) return std::nullopt;
  return Medium(GridMedium(DensityGrid{n, std::move(density)}, box, in.world_from_medium,
                           properties, phase));
}

std::optional<Medium> not_yet(const MediumContext& in) {
  in.parameters.ignore_all();
  in.parameters.reporter().unsupported(
      in.parameters.where(),
      fmt::format(
          "{}: media of type \"{}\" are not supported yet; empty space takes its place",
          in.parameters.owner(), in.parameters.string("type", "")));
  return std::nullopt;
}

struct MediumType {
  std::string_view name;
  std::optional<Medium> (*make)(const MediumContext&);
};

constexpr std::array medium_types{
    MediumType{"homogeneous", make_homogeneous},
    MediumType{"uniformgrid", make_uniform_grid},
    MediumType{"rgbgrid", not_yet},
    MediumType{"cloud", not_yet},
    MediumType{"nanovdb", not_yet},
};

}  // namespace

std::optional<Medium> make_medium(ParameterSet& parameters,
                                  const Transform& world_from_medium,
                                  const FileFinder& files) {
  const std::string type = parameters.required_string("type");
  std::vector<std::string_view> names;
  for (const MediumType& known : medium_types) {
    if (known.name == type) return known.make({parameters, world_from_medium, files});
    names.push_back(known.name);
  }
  parameters.fail_unknown_type("medium", type, names);
}

}  // namespace tyndall::loader
