// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/scene_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/tyndall/volume_info.h"

namespace tyndall::app {
namespace {

template <typename... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <typename... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;  // clang 14 does not find it by itself

const char* kind_of(const Shape& shape) {
  return std::visit(
      Overloaded{[](const TriangleMesh&) { return "triangle mesh"; },
                 [](const Sphere&) { return "sphere"; }, [](const Disk&) { return "disk"; },
                 [](const BilinearMesh&) { return "bilinear mesh"; }},
      shape);
}

const char* kind_of(const Medium& medium) {
  return medium.visit(Overloaded{[](const HomogeneousMedium&) { return "homogeneous"; },
                                 [](const OverlappingMedia&) { return "overlapping"; },
                                 [](const GridMedium&) { return "grid"; },
                                 [](const RgbGridMedium&) { return "rgb grid"; }});
}

Bounds3 bounds_of(const Medium& medium) {
  return medium.visit(Overloaded{[](const HomogeneousMedium&) { return Bounds3{}; },
                                 [](const OverlappingMedia&) { return Bounds3{}; },
                                 [](const auto& grid) { return grid.world_bounds(); }});
}

const std::vector<Surface>& surfaces_of(const SceneDescription& scene, size_t i) {
  return i == 0 ? scene.surfaces : scene.objects[i - 1];
}

struct Counts {
  std::map<std::string, int> shapes;
  size_t triangles = 0, area_lights = 0;
};

Counts count(const SceneDescription& scene) {
  Counts counts;
  for (size_t i = 0; i <= scene.objects.size(); ++i)
    for (const Surface& surface : surfaces_of(scene, i)) {
      ++counts.shapes[kind_of(surface.shape)];
      if (const auto* mesh = std::get_if<TriangleMesh>(&surface.shape))
        counts.triangles += mesh->triangles().size();
      counts.area_lights += surface.emission ? 1 : 0;
    }
  counts.area_lights += scene.hidden_emitters.size();
  return counts;
}

std::string shapes_text(const Counts& counts, size_t instances) {
  std::string text;
  for (const auto& [kind, n] : counts.shapes)
    text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", n, kind,
                        n == 1                ? ""
                        : kind.ends_with("h") ? "es"
                                              : "s");
  if (text.empty()) text = "none";
  if (counts.triangles > 0) text += fmt::format("; {} triangles", counts.triangles);
  if (instances > 0) text += fmt::format("; {} instances", instances);
  return text;
}

std::string medium_text(const Medium& medium) {
  std::string text = kind_of(medium);
  if (medium.is_emissive()) text += ", glowing";
  if (!medium.is_grey()) text += ", colored";
  const Bounds3 b = bounds_of(medium);
  if (!b.is_empty())
    text += fmt::format(", ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})", b.min.x, b.min.y,
                        b.min.z, b.max.x, b.max.y, b.max.z);
  if (medium.memory() > 0) text += fmt::format(", {}", short_bytes(medium.memory()));
  return text;
}

nlohmann::ordered_json medium_json(const Medium& medium) {
  nlohmann::ordered_json json = {{"kind", kind_of(medium)},
                                 {"glows", medium.is_emissive()},
                                 {"is_grey", medium.is_grey()},
                                 {"bounds", nullptr},
                                 {"memory_bytes", medium.memory()}};
  const Bounds3 b = bounds_of(medium);
  if (!b.is_empty())
    json["bounds"] = {{b.min.x, b.min.y, b.min.z}, {b.max.x, b.max.y, b.max.z}};
  return json;
}

}  // namespace

std::string scene_text(const std::string& path, const LoadedScene& loaded) {
  const SceneDescription& scene = loaded.scene;
  const RenderSettings& settings = loaded.settings;
  const Counts counts = count(scene);
  std::string text = fmt::format("{}\n", path);
  text += fmt::format("  picture   {}x{}, {} spp, at most {} scattering vertices, to {}\n",
                      settings.resolution.x, settings.resolution.y,
                      settings.samples_per_pixel, settings.max_depth, settings.output);
  text += fmt::format("  shapes    {}\n", shapes_text(counts, scene.instances.size()));
  text += fmt::format("  lights    {} and {} shapes that shine\n", scene.lights.size(),
                      counts.area_lights);
  for (size_t i = 0; i < scene.media.size(); ++i)
    text += fmt::format("  {}    {}\n", i == 0 ? "media " : "      ",
                        medium_text(scene.media[i]));
  if (!loaded.warnings.empty())
    text += fmt::format("  warnings  {}\n", loaded.warnings.size());
  return text;
}

nlohmann::ordered_json scene_json(const std::string& path, const LoadedScene& loaded) {
  const SceneDescription& scene = loaded.scene;
  const RenderSettings& settings = loaded.settings;
  const Counts counts = count(scene);
  nlohmann::ordered_json json = {
      {"file", path},
      {"kind", "scene"},
      {"resolution", {settings.resolution.x, settings.resolution.y}},
      {"samples_per_pixel", settings.samples_per_pixel},
      {"max_depth", settings.max_depth},
      {"output", settings.output},
      {"shapes", counts.shapes},
      {"triangles", counts.triangles},
      {"instances", scene.instances.size()},
      {"lights", scene.lights.size()},
      {"area_lights", counts.area_lights},
      {"media", nlohmann::ordered_json::array()},
      {"warnings", nlohmann::ordered_json::array()}};
  for (const Medium& medium : scene.media) json["media"].push_back(medium_json(medium));
  for (const Diagnostic& warning : loaded.warnings)
    json["warnings"].push_back(warning.text);
  return json;
}

}  // namespace tyndall::app
