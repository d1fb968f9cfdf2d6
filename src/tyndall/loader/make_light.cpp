// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/environment_picture.h"
#include "tyndall/loader/make_scene_parts.h"
#include "tyndall/loader/spectrum.h"

namespace tyndall::loader {
namespace {

struct LightContext {
  ParameterSet& parameters;
  const Transform& world_from_light;
  const FileFinder& files;
};

// pbrt-v4 divides lights by the luminance of their spectrum; so does
// SpectrumUse::illuminant.
Rgb read_color(const LightContext& in, std::string_view name) {
  const Rgb color =
      spectrum_parameter(in.parameters, name, SpectrumUse::illuminant, in.files)
          .value_or(Rgb(1));
  const Rgb scaled = color * in.parameters.number("scale", 1, not_negative);
  if (is_finite(scaled)) return scaled;
  in.parameters.error(name, fmt::format("\"{}\" times \"scale\" is too large", name));
  return color;
}

// The unit vector along `v`, whatever its length. Precondition: finite, not zero.
Vec3 direction(Vec3 v) { return normalize(v / max_component(abs(v))); }

// What is asked for in lumens or lux, or zero.
float read_photometric(ParameterSet& parameters, std::string_view name) {
  return parameters.number(name, 0);  // not positive means not given, as in pbrt-v4
}

std::optional<Light> make_point(const LightContext& in) {
  Rgb I = read_color(in, "I");
  const Vec3 from = in.parameters.point3("from").value_or(Vec3{});
  const float power = read_photometric(in.parameters, "power");
  if (power > 0) I *= power / (4 * pi);
  return Light(PointLight{in.world_from_light.point(from), I});
}

// Axis from "from" to "to"; reports points that coincide.
Vec3 read_axis(ParameterSet& parameters, Vec3 from) {
  const Vec3 to = parameters.point3("to").value_or(Vec3{0, 0, 1});
  const Vec3 axis = to - from;
  if (axis != Vec3{} && is_finite(axis)) return axis;
  parameters.error(
      "to", fmt::format("\"from\" and \"to\" must be two points, both are {} {} {}", to.x,
                        to.y, to.z));
  return {0, 0, 1};
}

std::optional<Light> make_spot(const LightContext& in) {
  ParameterSet& p = in.parameters;
  Rgb I = read_color(in, "I");
  const Vec3 from = p.point3("from").value_or(Vec3{});
  const Vec3 axis = read_axis(p, from);
  const float angle = p.number("coneangle", 30, {0, 180});
  const float delta = p.number("conedeltaangle", 5, {0, 180});
  const float cos_total = std::cos(radians(angle));
  const float cos_start = std::cos(radians(std::max(angle - delta, 0.0f)));
  const float power = read_photometric(p, "power");
  const float k = 2 * pi * ((1 - cos_start) + (cos_start - cos_total) / 2);
  if (power > 0 && k > 0) I *= power / k;
  return Light(SpotLight{in.world_from_light.point(from),
                         direction(in.world_from_light.vector(axis)), I, cos_total,
                         cos_start});
}

std::optional<Light> make_distant(const LightContext& in) {
  Rgb L = read_color(in, "L");
  const Vec3 from = in.parameters.point3("from").value_or(Vec3{});
  const Vec3 axis = read_axis(in.parameters, from);
  const float illuminance = read_photometric(in.parameters, "illuminance");
  if (illuminance > 0) L *= illuminance;
  return Light(DistantLight{direction(in.world_from_light.vector(-axis)), L});
}

std::optional<Light> make_picture_environment(const LightContext& in, float illuminance) {
  ParameterSet& p = in.parameters;
  const float scale = p.number("scale", 1, not_negative);
  const std::string path =
      in.files.find(p.required_string("filename"), p.where("filename"));
  EnvironmentPicture picture = read_environment(path, p.where("filename"));
  const float measured = illuminance > 0 ? picture.illuminance() : 0;
  return Light(ImageEnvironment(in.world_from_light, picture.resolution,
                                std::move(picture.pixels),
                                measured > 0 ? scale * illuminance / measured : scale));
}

std::optional<Light> make_infinite(const LightContext& in) {
  ParameterSet& p = in.parameters;
  if (p.has("portal"))
    p.unsupported("portal",
                  "portals are not supported yet; the light shines from everywhere");
  p.ignore({"portal"});
  const float illuminance = read_photometric(p, "illuminance");
  if (p.has("filename")) {
    if (p.has("L")) p.error("L", "\"L\" and \"filename\" cannot both be given");
    p.ignore({"L"});
    return make_picture_environment(in, illuminance);
  }
  Rgb L = read_color(in, "L");
  if (illuminance > 0) L *= illuminance / pi;
  return Light(ConstantEnvironment{L});
}

std::optional<Light> not_yet(const LightContext& in) {
  in.parameters.ignore_all();
  in.parameters.reporter().unsupported(
      in.parameters.where(),
      fmt::format("{}: not supported yet, skipped", in.parameters.owner()));
  return std::nullopt;
}

struct LightType {
  std::string_view name;
  std::optional<Light> (*make)(const LightContext&);
};

constexpr std::array light_types{
    LightType{"point", make_point},     LightType{"spot", make_spot},
    LightType{"distant", make_distant}, LightType{"infinite", make_infinite},
    LightType{"goniometric", not_yet},  LightType{"projection", not_yet},
};

}  // namespace

std::optional<Light> make_light(const std::string& type, ParameterSet& parameters,
                                const Transform& world_from_light,
                                const FileFinder& files) {
  std::vector<std::string_view> names;
  for (const LightType& known : light_types) {
    if (known.name == type) return known.make({parameters, world_from_light, files});
    names.push_back(known.name);
  }
  parameters.fail_unknown_type("light", type, names);
}

std::optional<AreaLightRequest> make_area_light(const std::string& type,
                                                ParameterSet& parameters,
                                                const FileFinder& files) {
  if (type != "diffuse") parameters.fail_unknown_type("area light", type, {"diffuse"});
  if (parameters.has("filename"))
    parameters.unsupported(
        "filename", "emission pictures are not supported yet; the light shines evenly");
  parameters.ignore({"filename"});
  const Rgb L = read_color({parameters, {}, files}, "L");
  return AreaLightRequest{L, parameters.boolean("twosided", false),
                          read_photometric(parameters, "power")};
}

}  // namespace tyndall::loader
