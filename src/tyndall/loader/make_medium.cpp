// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string_view>

#include "tyndall/loader/make_scene_parts.h"
#include "tyndall/loader/medium_parameters.h"
#include "tyndall/media/cloud_density.h"

namespace tyndall::loader {
namespace {

constexpr MediumPreset whole_milk{"", {2.55f, 3.21f, 3.77f}, {0.0011f, 0.0024f, 0.014f}};

// Coefficients, and Le times Lescale.
MediumProperties read_constants(const MediumContext& in, const MediumPreset& otherwise) {
  MediumProperties properties = read_properties(in, otherwise);
  properties.Le *= in.parameters.number("Lescale", 1, not_negative);
  return properties;
}

std::optional<Medium> make_homogeneous(const MediumContext& in) {
  const MediumProperties properties = read_constants(in, whole_milk);
  return Medium(HomogeneousMedium(properties, read_phase_function(in.parameters)));
}

std::optional<Medium> make_cloud_medium(const MediumContext& in) {
  ParameterSet& p = in.parameters;
  const MediumProperties properties = read_constants(in, unit_coefficients);
  const PhaseFunction phase = read_phase_function(p);
  const Bounds3 box = read_box(p);
  const CloudParameters cloud{.density = p.number("density", 1, not_negative),
                              .wispiness = p.number("wispiness", 1, not_negative),
                              .frequency = p.number("frequency", 5, not_negative)};
  if (p.reporter().has_errors()) return std::nullopt;  // a cloud takes seconds
  return Medium(
      GridMedium(make_cloud(cloud, box), in.world_from_medium, properties, phase));
}

struct MediumType {
  std::string_view name;
  std::optional<Medium> (*make)(const MediumContext&);
};

constexpr std::array medium_types{
    MediumType{"homogeneous", make_homogeneous},
    MediumType{"uniformgrid", make_uniform_grid},
    MediumType{"rgbgrid", make_rgb_grid},
    MediumType{"cloud", make_cloud_medium},
    MediumType{"nanovdb", make_volume},
    MediumType{"openvdb", make_volume},
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
