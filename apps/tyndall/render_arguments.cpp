// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/render_arguments.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "tyndall/integrators/render.h"

namespace tyndall::app {

namespace {

/// A parser that stores what `parse` makes of a text.
template <typename Target, typename Parse>
ArgumentParser store(Target* target, Parse parse) {
  return [target, parse](const std::string& text) { *target = parse(text); };
}

uint32_t parse_sample_count(const std::string& text) {
  return parse_whole_number(text, uint32_t{1});
}

float parse_exposure(const std::string& text) {
  const float stops = parse_number<float>(text);
  if (!(std::abs(stops) <= 100))
    throw std::invalid_argument(
        fmt::format("must lie between -100 and 100, got '{}'", text));
  return stops;
}

void declare_quality(Command& command, RenderArguments& a) {
  const std::string group = "Quality";
  command
      .option("--spp,--samples", store(&a.samples_per_pixel, parse_sample_count),
              "samples per pixel", {.value = "N", .group = group})
      .option("--time", store(&a.time_limit, parse_duration),
              "stop after this time, from the end of loading on: 30s, 10m, 1h30m",
              {.value = "TIME", .group = group})
      .option("--integrator", &a.integrator, "how light is transported [learned]",
              {.choices = integrator_names(), .group = group})
      .option("--maxdepth", store(&a.max_depth, parse_depth),
              "most scattering vertices between camera and light, as pbrt counts them",
              {.value = "N", .group = group})
      .option(
          "--orders", store(&a.orders, parse_orders),
          "keep only paths with this many scattering events in media: 1, 2 or 1-2; bounces "
          "on surfaces are not counted",
          {.value = "A[-B]", .group = group})
      .option("--sampler", &a.sampler, "random numbers",
              {.choices = {"sobol", "independent"}, .group = group})
      .option("--seed", &a.seed, "another number gives another, independent picture",
              {.value = "N", .group = group})
      .option("--set",
              [&a](const std::string& text) {
                a.assignments.push_back(parse_assignment(text));
              },
              "set an option of the integrator, see docs/guiding.md; a name that does not "
              "exist lists all; may be repeated",
              {.value = "NAME=VALUE", .group = group, .repeatable = true});
}

void declare_picture(Command& command, RenderArguments& a) {
  const std::string group = "Picture";
  command
      .option("--size", store(&a.size, parse_size), "width and height in pixels",
              {.value = "WxH", .group = group})
      .option("--crop", store(&a.crop, parse_crop),
              "render this part only: pixels, or fractions where no value is above 1",
              {.value = "X0,Y0,X1,Y1", .group = group})
      .option("--pixel", store(&a.pixel, parse_pixel),
              "render this pixel only and print it", {.value = "X,Y", .group = group});
}

void declare_output(Command& command, RenderArguments& a) {
  const std::string group = "Output";
  command
      .option("-o,--output,--outfile", &a.outputs,
              "where the image goes: .exr (linear, all layers), .png (8 bit sRGB), .pfm or "
              ".hdr; may be repeated; without it the name in the scene file",
              {.value = "FILE", .group = group})
      .flag("--half", &a.half, "EXR: 16-bit channels; depth and sample counts stay 32-bit",
            group)
      .flag("--float", &a.full_float, "EXR: 32-bit channels, the default", group)
      .option("--exposure", store(&a.exposure, parse_exposure),
              "PNG: brighten by so many stops", {.value = "STOPS", .group = group})
      .option("--tone", &a.tone, "PNG: how values above 1 are brought into range",
              {.choices = {"plain", "filmic"}, .group = group})
      .option("--dump-guiding", &a.guiding,
              "write what the integrator has learned, for tyndall inspect",
              {.value = "FILE", .group = group});
}

void declare_running(Command& command, RenderArguments& a) {
  const std::string group = "Running";
  command
      .option("-t,--threads,--nthreads", store(&a.threads, parse_threads),
              "worker threads; 0 is as many as this process may use",
              {.value = "N", .group = group})
      .option("--progress", &a.progress, "how progress is shown on stderr",
              {.choices = {"auto", "bar", "line", "farm", "none"}, .group = group})
      .option("--stats", &a.stats, "print statistics of the render to stdout",
              {.choices = {"json"}, .group = group})
      .flag("-q,--quiet", &a.quiet, "print errors only", group)
      .flag("-v,--verbose", &a.verbose, "print all statistics on stderr", group)
      .flag("--strict", &a.strict, "what the scene asks for and tyndall lacks is an error",
            group)
      .flag("--dry-run", &a.dry_run, "load the scene, check the outputs, render nothing",
            group);
}

void apply_window(const RenderArguments& a, RenderSettings& settings) {
  const Vec2i size = settings.resolution;
  if (a.crop) {
    const auto window = a.crop->pixels(size);
    settings.crop_min = window.first;
    settings.crop_max = window.second;
    if (settings.crop_min.x >= settings.crop_max.x ||
        settings.crop_min.y >= settings.crop_max.y)
      throw UsageError(fmt::format("--crop: the window holds no pixel of the {}x{} picture",
                                   size.x, size.y));
  }
  if (a.pixel) {
    if (a.pixel->x >= size.x || a.pixel->y >= size.y)
      throw UsageError(fmt::format("--pixel: {},{} lies outside the {}x{} picture",
                                   a.pixel->x, a.pixel->y, size.x, size.y));
    settings.crop_min = *a.pixel;
    settings.crop_max = {a.pixel->x + 1, a.pixel->y + 1};
  }
}

/// A new size keeps the part of the picture that the scene's crop window covers.
void resize(Vec2i size, RenderSettings& s) {
  const auto scale = [](int value, int to, int from) {
    return static_cast<int>((static_cast<int64_t>(value) * to + from - 1) / from);
  };
  s.crop_min = {scale(s.crop_min.x, size.x, s.resolution.x),
                scale(s.crop_min.y, size.y, s.resolution.y)};
  s.crop_max = {scale(s.crop_max.x, size.x, s.resolution.x),
                scale(s.crop_max.y, size.y, s.resolution.y)};
  s.resolution = size;
}

/// What the command line says wins over the environment; both at once is a mistake.
bool wants_half(const RenderArguments& a) {
  if (!(a.half && a.full_float)) return a.half;
  const bool half_may_be_ambient = std::getenv("TYNDALL_HALF") != nullptr;
  const bool float_may_be_ambient = std::getenv("TYNDALL_FLOAT") != nullptr;
  if (half_may_be_ambient == float_may_be_ambient)
    throw UsageError("--half and --float exclude each other");
  return float_may_be_ambient;
}

}  // namespace

void declare_render_arguments(Command& command, RenderArguments& arguments) {
  command.positional("SCENE", &arguments.scene, "a scene in the pbrt-v4 format",
                     {.required = true});
  declare_output(command, arguments);
  declare_quality(command, arguments);
  declare_picture(command, arguments);
  declare_running(command, arguments);
}

void apply(const RenderArguments& a, RenderSettings& settings) {
  if (a.samples_per_pixel) settings.samples_per_pixel = *a.samples_per_pixel;
  if (a.integrator) settings.integrator = *a.integrator;
  if (a.max_depth) settings.max_depth = *a.max_depth;
  if (a.orders) settings.orders = *a.orders;
  if (a.seed) settings.seed = *a.seed;
  if (a.sampler)
    settings.sampler =
        *a.sampler == "sobol" ? SamplerKind::sobol : SamplerKind::independent;
  for (const auto& [name, value] : a.assignments) settings.options[name] = value;
  if (a.size) resize(*a.size, settings);
  apply_window(a, settings);
}

WriteOptions write_options(const RenderArguments& a) {
  WriteOptions options;
  options.half = wants_half(a);
  options.threads = a.threads;
  options.tone.dither = true;
  options.tone.exposure = a.exposure;
  options.tone.curve = a.tone == "filmic" ? ToneCurve::filmic : ToneCurve::plain;
  return options;
}

}  // namespace tyndall::app
