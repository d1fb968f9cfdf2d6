// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/medium_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/spectrum.h"

namespace tyndall::loader {
namespace {

std::optional<MediumPreset> read_preset(ParameterSet& parameters) {
  const std::string name = parameters.string("preset", "");
  if (name.empty()) return std::nullopt;
  std::optional<MediumPreset> preset = medium_preset(name);
  if (!preset)
    parameters.error("preset", fmt::format("there is no preset \"{}\"{}", name,
                                           did_you_mean(name, medium_preset_names())));
  return preset;
}

}  // namespace

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

Vec3i read_resolution(ParameterSet& parameters) {
  constexpr Range side{1, 1 << 16};
  return {parameters.integer("nx", 1, side), parameters.integer("ny", 1, side),
          parameters.integer("nz", 1, side)};
}

Bounds3 read_box(ParameterSet& parameters) {
  const Vec3 p0 = parameters.point3("p0").value_or(Vec3{0, 0, 0});
  const Vec3 p1 = parameters.point3("p1").value_or(Vec3{1, 1, 1});
  Bounds3 box;
  box.extend(p0);
  box.extend(p1);
  const Vec3 size = box.diagonal();
  if (size.x > 0 && size.y > 0 && size.z > 0 && is_finite(size)) return box;
  parameters.error(
      "p1", fmt::format("the box from p0 to p1 has no volume or is too large; got p0 = {} "
                        "{} {}, p1 = {} {} {}",
                        p0.x, p0.y, p0.z, p1.x, p1.y, p1.z));
  return {{0, 0, 0}, {1, 1, 1}};
}

std::optional<DensityGrid> read_grid(ParameterSet& parameters, std::string_view name,
                                     Vec3i n) {
  if (!parameters.has(name)) return std::nullopt;
  std::vector<float> values = parameters.numbers(name);
  const size_t expected =
      static_cast<size_t>(n.x) * static_cast<size_t>(n.y) * static_cast<size_t>(n.z);
  if (values.size() != expected) {
    parameters.error(
        name,
        fmt::format("nx * ny * nz = {} * {} * {} = {} values of \"{}\" expected, got {}",
                    n.x, n.y, n.z, expected, name, values.size()));
    return std::nullopt;
  }
  const auto bad =
      std::find_if(values.begin(), values.end(), [](float x) { return !(x >= 0); });
  if (bad != values.end()) {
    parameters.error(name, fmt::format("value {} of \"{}\" must not be negative, got {}",
                                       bad - values.begin(), name, *bad));
    return std::nullopt;
  }
  const auto large = std::count_if(values.begin(), values.end(),
                                   [](float x) { return x > BrickGrid::largest; });
  warn_of_rejected(parameters, name, name, {.not_finite = static_cast<uint64_t>(large)});
  return DensityGrid{n, std::move(values)};
}

void warn_of_rejected(const ParameterSet& parameters, std::string_view name,
                      std::string_view what, const BrickGrid::Rejected& rejected) {
  if (rejected.negative == 0 && rejected.not_finite == 0) return;
  const std::string large = fmt::format("no numbers or above {:g}", BrickGrid::largest);
  const std::string kind = rejected.not_finite == 0 ? "negative"
                           : rejected.negative == 0 ? large
                                                    : "negative, " + large;
  parameters.warning(
      name,
      fmt::format("the {} grid holds values that are {}, which count as zero", what, kind));
}

void warn_if_empty(const ParameterSet& parameters, std::string_view name,
                   const PlacedGrid& density) {
  if (density.grid->is_empty())
    parameters.warning(name, "the density is zero everywhere: an empty medium");
}

void warn_of_reduced(const ParameterSet& parameters, std::string_view name,
                     bool is_reduced) {
  if (!is_reduced) return;
  parameters.warning(name,
                     "some densities are reduced: from one sample to the next they would "
                     "make an optical depth of more than 1e6");
}

TemperatureScale read_temperature_scale(ParameterSet& parameters) {
  const float cutoff = parameters.number("temperaturecutoff", 0);
  return {parameters.number("temperatureoffset", cutoff),
          parameters.number("temperaturescale", 1, not_negative)};
}

}  // namespace tyndall::loader
