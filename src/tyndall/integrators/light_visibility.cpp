// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/light_visibility.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <numeric>

#include "tyndall/integrators/light_aim.h"
#include "tyndall/integrators/pilot_points.h"
#include "tyndall/integrators/sky_probe.h"
#include "tyndall/math/parallel_for.h"
#include "tyndall/math/vector_clones.h"
#include "tyndall/techniques/distance_weights.h"

namespace tyndall {
namespace {

constexpr unsigned max_resolution = 512, min_resolution = 16;
constexpr size_t max_taps = 128;
constexpr int depth_resolution = 32, depth_steps = 16;

int resolution_for(double texels) {
  const auto side = static_cast<unsigned>(std::sqrt(texels));
  return static_cast<int>(std::bit_floor(std::clamp(side, min_resolution, max_resolution)));
}

template <typename Body>
void for_rows(int count, const Body& body) {
  parallel_for(static_cast<size_t>(count),
               [&](size_t row) { body(static_cast<int>(row)); });
}

std::shared_ptr<const VisibilityMap> trace_map(const LightAim& aim,
                                               VisibilityMapSettings settings) {
  settings.lit_outside = aim.is_lit_outside();
  settings.edge_depth = aim.edge_depth();
  auto map = std::make_shared<VisibilityMap>(aim.view(), settings);
  const auto trace = [&](const Ray& ray, Vec2 u) { return aim.reach(ray, u); };
  for_rows(map->sketch_rows(), [&](int row) { map->sketch_row(row, trace); });
  for_rows(map->rows(), [&](int row) { map->refine_rows(row, row + 1, trace); });
  map->finish();
  return map;
}

OpticalDepthMap trace_depths(const LightAim& aim) {
  OpticalDepthMap map(aim.view(), aim.range(), depth_resolution, depth_steps);
  for_rows(map.rows(), [&](int row) {
    map.trace_rows(row, row + 1,
                   [&](const Ray& ray, std::span<const float> t, std::span<float> out) {
                     aim.optical_depth(ray, t, out);
                   });
  });
  return map;
}

// Environments are everywhere, and media that glow hide behind nothing but themselves.
bool has_map(const Light& light) {
  return !light.is_environment() && !std::holds_alternative<VolumeLight>(light.variant());
}

// Whether the transmittance between two points is more than a matter of their distance.
bool has_varied_media(const Scene& scene) {
  const auto& media = scene.description().media;
  return media.size() > 1 || (!media.empty() && !media.front().is_homogeneous());
}

}  // namespace

LightVisibility::LightVisibility(const Scene& scene,
                                 const LightVisibilitySettings& settings) {
  const std::vector<Vec3> points = pilot_points(scene);
  const auto power_of = [&](const Light& light) {
    return has_map(light) ? double{luminance(light.power(scene.bounds().radius()))} : 0.0;
  };
  const bool is_varied = has_varied_media(scene);
  double power = 0;
  for (const Light& light : scene.lights()) power += power_of(light);
  for (size_t i = 0; i < scene.lights().size(); ++i) {
    const Light& light = scene.lights()[i];
    if (points.empty()) continue;
    if (light.is_environment()) measure_sky(i, scene, points, settings);
    if (!has_map(light)) continue;
    const double share = power > 0 ? power_of(light) / power : 0;
    const VisibilityMapSettings map{
        .resolution = resolution_for(share * static_cast<double>(settings.texels)),
        .floor = settings.floor};
    const LightAim aim(scene, light, points);
    maps_[i] = trace_map(aim, map);
    if (is_varied) depths_.emplace(i, trace_depths(aim));
  }
}

void LightVisibility::measure_sky(size_t light, const Scene& scene,
                                  std::span<const Vec3> points,
                                  const LightVisibilitySettings& settings) {
  Bounds3 box;
  for (const Vec3 p : points) box.extend(p);
  const CellGrid cells(box, settings.cells);
  ExposureGrid exposure(cells, settings.floor);
  auto guide = std::make_shared<SkyGuide>(cells);
  const SkyProbe probe(scene, scene.lights()[light]);
  for_rows(cells.size(2), [&](int z) {
    for (int y = 0; y < cells.size(1); ++y)
      for (int x = 0; x < cells.size(0); ++x) {
        const size_t cell = cells.index(x, y, z);
        const SkyGuide::Weights seen = probe.look(cells.middle(x, y, z), cell);
        exposure.set(cell, std::accumulate(seen.begin(), seen.end(), 0.0f));
        guide->set(cell, seen);
      }
  });
  exposure.finish();
  guide->finish();
  exposures_.emplace(light, std::move(exposure));
  skies_.emplace(light, std::move(guide));
}

TYNDALL_VECTOR_CLONES
void LightVisibility::multiply(size_t light, const Ray& ray, std::span<const float> t,
                               float footprint, std::span<float> weights) const {
  assert(t.size() <= max_taps && t.size() == 2 * weights.size());
  std::array<float, max_taps> visibility;
  const std::span<float> seen(visibility.data(), t.size());
  if (const auto map = maps_.find(light); map != maps_.end())
    map->second->visibility(ray, t, seen, map->second->level_of(footprint));
  else if (const auto sky = exposures_.find(light); sky != exposures_.end())
    sky->second.exposure(ray, t, seen);
  else
    return;
  std::array<float, max_taps / 2 + 2> means;
  for (size_t i = 0; i < weights.size(); ++i)
    means[i + 1] = 0.5f * (visibility[2 * i] + visibility[2 * i + 1]);
  multiply_mixed(means, weights);
}

void LightVisibility::multiply_transmittance(size_t light, const Ray& ray,
                                             std::span<const float> t,
                                             std::span<float> weights) const {
  const auto map = depths_.find(light);
  if (map == depths_.end()) return;
  assert(t.size() <= max_taps && t.size() == weights.size());
  std::array<float, max_taps> transmittance;
  map->second.transmittance(ray, t, std::span<float>(transmittance.data(), t.size()));
  for (size_t i = 0; i < t.size(); ++i) weights[i] *= transmittance[i];
}

size_t LightVisibility::memory() const {
  size_t bytes = 0;
  for (const auto& [light, map] : depths_) bytes += map.memory();
  for (const auto& [light, map] : maps_) bytes += map->memory();
  for (const auto& [light, exposure] : exposures_) bytes += exposure.memory();
  for (const auto& [light, sky] : skies_) bytes += sky->memory();
  return bytes;
}

}  // namespace tyndall
