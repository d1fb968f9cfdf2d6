// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <span>
#include <stdexcept>

#include "apps/tyndall/commands.h"
#include "apps/tyndall/inspect/direction_maps.h"
#include "apps/tyndall/inspect/distance_curves.h"
#include "apps/tyndall/inspect/visibility_picture.h"
#include "apps/tyndall/parse_values.h"
#include "apps/tyndall/scene_input.h"
#include "apps/tyndall/write_outputs.h"
#include "tyndall/image/whole_file.h"

namespace tyndall::app {

namespace {

struct InspectArguments {
  std::string file, scene;
  std::vector<std::string> outputs;
  std::optional<Vec2i> pixel;
  std::optional<uint32_t> light;
  std::optional<float> at;
};

GuidingFile read_file(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  try {
    return read_guiding_file(std::as_bytes(std::span(bytes)));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
  }
}

double lit_share(const VisibilityMap& map) {
  int64_t lit = 0;
  for (int y = 0; y < map.rows(); ++y)
    for (int x = 0; x < map.rows(); ++x)
      for (const float d : map.distances(x, y)) lit += d > 0 ? 1 : 0;
  return static_cast<double>(lit) / (4.0 * map.rows() * map.rows());
}

bool holds_nothing(const GuidingFile& file) {
  const bool is_trained = file.records && file.records->statistics().trained_guides > 0;
  return file.maps.empty() && !is_trained;
}

void print_statistics(const GuidingFile& file) {
  const double share = file.seconds > 0 ? file.training_seconds / file.seconds : 0;
  fmt::print("time       {:.2f} s, {:.1f} % of it training\n", file.seconds, 100 * share);
  if (holds_nothing(file))
    fmt::print("nothing    was learned: no visibility maps, no trained mixtures\n");
  for (const auto& [light, map] : file.maps)
    fmt::print(
        "light {:<4} visibility map {}x{}, {:.1f} MB, floor {:g}, {:.1f} % of its "
        "view lit\n",
        light, map->rows(), map->rows(), 1e-6 * static_cast<double>(map->memory()),
        map->floor(), 100 * lit_share(*map));
  if (!file.records) return;
  const GuidingStatistics s = file.records->statistics();
  const double per_record =
      s.records > 0 ? static_cast<double>(s.samples) / static_cast<double>(s.records) : 0;
  fmt::print(
      "records    {}, {:.0f} samples each, radius {:.3g}\n"
      "mixtures   {} of {} trained, {:.1f} effective components, leak {:.2f} %, share of "
      "samples {:.0f} %\n"
      "memory     {:.2f} MB of records and mixtures; a render holds samples too\n",
      s.records, per_record, s.radius, s.trained_guides, s.guides, s.effective_components,
      100 * s.leak, 100 * s.mixture_share, 1e-6 * static_cast<double>(s.memory));
}

void check_arguments(const InspectArguments& a) {
  if (a.pixel && a.scene.empty()) throw UsageError("--pixel needs --scene");
  if (!a.scene.empty() && !a.pixel) throw UsageError("--scene needs --pixel");
  if (a.at && !a.pixel) throw UsageError("--at needs --pixel");
  if ((a.pixel || a.light) && a.outputs.empty())
    throw UsageError("a picture needs -o FILE");
  check_outputs(a.outputs);
}

// What a picture's title and the terminal say of a density and of the one it improves on.
std::string variances(float learned, float without, const char* name_of_other) {
  if (learned < 0) return "no light of this lamp arrives";
  return fmt::format("relative variance {:.3g} learned, {:.3g} {}", learned, without,
                     name_of_other);
}

Image directions_picture(const InspectArguments& a, const DirectionMaps& maps) {
  const std::string found =
      variances(maps.learned_variance, maps.joint_variance, "by joint sampling");
  fmt::print("light {}: directions: {}\n", maps.light, found);
  return draw_direction_maps(maps, fmt::format("directions at {:g} along pixel {},{}: {}",
                                               *a.at, a.pixel->x, a.pixel->y, found));
}

void check_scene(const InspectArguments& a, const GuidingFile& file, const Scene& scene) {
  const std::string how =
      file.scene ? difference(*file.scene, SceneMark::of(scene)) : std::string();
  if (!how.empty())
    throw std::runtime_error(fmt::format("{}: it was learned in another scene than {}, {}",
                                         a.file, a.scene, how));
}

Image pixel_picture(const InspectArguments& a, const GuidingFile& file) {
  SceneInput input(a.scene, false, true);
  LoadedScene loaded = input.load();
  const Vec2i size = loaded.settings.resolution;
  if (a.pixel->x >= size.x || a.pixel->y >= size.y)
    throw UsageError(fmt::format("--pixel: {},{} lies outside the {}x{} picture",
                                 a.pixel->x, a.pixel->y, size.x, size.y));
  const Scene scene(std::move(loaded.scene));
  check_scene(a, file, scene);
  const Vec2 p_film{static_cast<float>(a.pixel->x) + 0.5f,
                    static_cast<float>(a.pixel->y) + 0.5f};
  const Ray ray = scene.camera().ray(p_film, {0.5f, 0.5f});
  const auto light = a.light ? std::optional<size_t>(*a.light) : std::nullopt;
  if (a.at) return directions_picture(a, direction_maps(scene, file, ray, *a.at, light));
  const DistanceCurves curves = distance_curves(scene, file, ray, light);
  const std::string found =
      variances(curves.learned_variance, curves.equiangular_variance, "without visibility");
  fmt::print("light {}: distances: {}\n", curves.light, found);
  return draw_plot(
      fmt::format("pixel {},{}, light {}: {}", a.pixel->x, a.pixel->y, curves.light, found),
      "distance along the ray [scene units]", "density [1/unit]",
      {curves.truth, curves.equiangular, curves.learned});
}

Image map_picture(const InspectArguments& a, const GuidingFile& file) {
  if (file.maps.empty())
    throw std::runtime_error(fmt::format("{}: it holds no visibility maps", a.file));
  const size_t light = a.light ? *a.light : file.maps.begin()->first;
  const auto map = file.maps.find(light);
  if (map == file.maps.end())
    throw UsageError(fmt::format("--light: there is no map of light {}", light));
  return visibility_picture(*map->second, light);
}

ExitCode run_inspect_command(const InspectArguments& a) {
  check_arguments(a);
  const GuidingFile file = read_file(a.file);
  print_statistics(file);
  if (!a.outputs.empty())
    write_outputs(a.pixel ? pixel_picture(a, file) : map_picture(a, file), a.outputs, {});
  return ExitCode::done;
}

}  // namespace

void add_inspect_command(Program& program) {
  const auto a = std::make_shared<InspectArguments>();
  Command command = program.add_command(
      "inspect", "Show what a render has learned, as text and pictures");
  command
      .positional("FILE", &a->file, "a file of tyndall render --dump-guiding",
                  {.value = "", .required = true})
      .option("-o,--output", &a->outputs,
              "a picture: what a light sees, or with --pixel the densities along a ray",
              {.value = "FILE"})
      .option("--light", &a->light,
              "index of the light [the first with a map; with --pixel the likeliest]",
              {.value = "N"})
      .option("--scene", &a->scene, "the scene that was rendered", {.value = "FILE"})
      .option(
          "--pixel",
          ArgumentParser([a](const std::string& s) { a->pixel = parse_pixel(s); }),
          "draw the learned density of distances along this pixel's ray beside the true "
          "single scattering, by brute force",
          {.value = "X,Y"})
      .option("--at", &a->at,
              "draw the directions of two scattering events instead: those learned for the "
              "first at this distance along the pixel's ray, beside the true light",
              {.value = "T"})
      .footer(
          "Example:\n  tyndall render fog.pbrt --integrator learned --dump-guiding "
          "fog.guide\n  tyndall inspect fog.guide --scene fog.pbrt --pixel 64,64 -o "
          "density.png\n\n" +
          exit_code_help())
      .on_run([a] { return run_inspect_command(*a); });
}

}  // namespace tyndall::app
