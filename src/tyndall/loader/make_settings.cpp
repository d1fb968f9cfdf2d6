// SPDX-License-Identifier: Apache-2.0
// Sampler, PixelFilter and Integrator.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/make_scene_parts.h"

namespace tyndall::loader {
namespace {

using Names = std::vector<std::string_view>;

// Throws Failure unless `type` is one of the names.
void check_type(const std::string& type, const ParameterSet& parameters, const Names& names,
                std::string_view what) {
  if (std::find(names.begin(), names.end(), type) == names.end())
    parameters.fail_unknown_type(what, type, names);
}

constexpr Range at_least_one{1, infinity};

uint32_t stratified_samples(ParameterSet& parameters) {
  parameters.ignore({"jitter"});
  const int x = parameters.integer("xsamples", 4, {1, 65536});
  const int y = parameters.integer("ysamples", 4, {1, 32767});
  return static_cast<uint32_t>(x) * static_cast<uint32_t>(y);
}

}  // namespace

void set_sampler(const std::string& type, ParameterSet& parameters,
                 RenderSettings& settings) {
  const Names names{"independent", "halton",  "paddedsobol", "zsobol",
                    "sobol",       "pmj02bn", "stratified"};
  check_type(type, parameters, names, "sampler");
  settings.sampler = type == "independent" ? SamplerKind::independent : SamplerKind::sobol;
  settings.samples_per_pixel =
      type == "stratified"
          ? stratified_samples(parameters)
          : static_cast<uint32_t>(parameters.integer("pixelsamples", 16, at_least_one));
  if (parameters.has("seed"))
    settings.seed = static_cast<uint64_t>(parameters.integer("seed", 0, not_negative));
  parameters.ignore({"randomization"});
}

void set_pixel_filter(const std::string& type, ParameterSet& parameters,
                      RenderSettings& settings) {
  check_type(type, parameters, {"box", "gaussian", "mitchell", "sinc", "triangle"},
             "pixel filter");
  FilterSettings filter;
  float radius = 2;  // triangle and mitchell
  if (type == "box") {
    filter.kind = FilterKind::box;
    radius = 0.5f;
  } else if (type == "triangle") {
    filter.kind = FilterKind::triangle;
  } else if (type == "gaussian") {
    filter.kind = FilterKind::gaussian;
    radius = 1.5f;
    filter.sigma = parameters.number("sigma", 0.5f, positive);
  } else {
    filter.kind = FilterKind::mitchell;
    filter.b = parameters.number("B", filter.b);
    filter.c = parameters.number("C", filter.c);
  }
  if (type == "sinc") {
    parameters.reporter().unsupported(
        parameters.where(),
        fmt::format("{}: not supported yet, \"mitchell\" of radius 2 is used instead",
                    parameters.owner()));
    parameters.ignore({"tau", "xradius", "yradius"});
  }
  filter.radius.x =
      type == "sinc" ? radius : parameters.number("xradius", radius, positive);
  filter.radius.y =
      type == "sinc" ? radius : parameters.number("yradius", radius, positive);
  settings.filter = filter;
}

void set_integrator(const std::string& type, ParameterSet& parameters,
                    RenderSettings& settings) {
  check_type(type, parameters,
             {"volpath", "simplevolpath", "path", "simplepath", "bdpt", "mlt", "sppm",
              "lightpath", "randomwalk", "ambientocclusion", "function"},
             "integrator");
  settings.max_depth = parameters.integer("maxdepth", 5, not_negative);
  parameters.ignore({"regularize",
                     "lightsampler",
                     "samplelights",
                     "samplebsdf",
                     "visualizestrategies",
                     "visualizeweights",
                     "bootstrapsamples",
                     "chains",
                     "mutationsperpixel",
                     "largestepprobability",
                     "sigma",
                     "photonsperiteration",
                     "radius",
                     "seed",
                     "cossample",
                     "maxdistance",
                     "function",
                     "filename",
                     "skipbad",
                     "rrthreshold",
                     "pixelsamples"});
}

}  // namespace tyndall::loader
