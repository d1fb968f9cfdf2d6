// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/light_visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>

namespace tyndall {
namespace {

constexpr int max_resolution = 256, min_resolution = 16;
constexpr size_t max_batch = 64;
constexpr int max_own_hits = 8;

LightView view_of(const Light& light, const LightExtent& extent) {
  if (const auto* spot = std::get_if<SpotLight>(&light.variant()))
    return LightView::cone(spot->p, spot->axis, spot->cos_total);
  return LightView::around(extent.box.center());
}

// Distance to the first opaque surface that is not the light itself.
float distance_to_occluder(const Scene& scene, const Light& light, Ray ray) {
  float t = 0;
  for (int i = 0; i < max_own_hits; ++i) {
    const std::optional<SurfaceHit> hit = scene.intersect_opaque(ray, infinity);
    if (!hit) return infinity;
    t += hit->t;
    if (hit->light != &light) return t;
    ray.o = offset_origin(hit->point.p, hit->point.ng, ray.d);
  }
  return t;
}

std::unique_ptr<const VisibilityMap> trace_map(const Scene& scene, const Light& light,
                                               const VisibilityMapSettings& settings) {
  const std::optional<LightExtent> extent = light.extent();
  if (!extent) return nullptr;
  auto map = std::make_unique<VisibilityMap>(view_of(light, *extent), settings);
  VisibilityMap::Origin origin;
  if (std::holds_alternative<AreaLight>(light.variant()))
    origin = [&](Vec2 u) {
      const std::optional<LightPoint> point = light.sample_point(u);
      return point ? point->on.p : extent->box.center();
    };
  tbb::parallel_for(0, map->rows(), [&](int row) {
    map->trace_rows(
        row, row + 1,
        [&](const Ray& ray) { return distance_to_occluder(scene, light, ray); }, origin);
  });
  map->finish();
  return map;
}

}  // namespace

LightVisibility::LightVisibility(const Scene& scene, size_t max_bytes, float floor) {
  const size_t count = std::max<size_t>(scene.lights().size(), 1);
  VisibilityMapSettings settings;
  settings.floor = floor;
  settings.resolution = max_resolution;
  // Four distances a texel, and a third more for the pyramid.
  constexpr size_t bytes_per_texel = 22;
  while (settings.resolution > min_resolution &&
         count * bytes_per_texel * static_cast<size_t>(sqr(settings.resolution)) >
             max_bytes)
    settings.resolution /= 2;
  for (const Light& light : scene.lights())
    maps_.push_back(trace_map(scene, light, settings));
}

void LightVisibility::multiply(size_t light, const Ray& ray, std::span<const float> t,
                               float footprint, std::span<float> weights) const {
  const VisibilityMap* map = maps_[light].get();
  if (!map) return;
  assert(t.size() <= max_batch);
  std::array<float, max_batch> visibility;
  const std::span<float> out(visibility.data(), t.size());
  map->visibility(ray, t, out, map->level_of(footprint));
  for (size_t i = 0; i < t.size(); ++i) weights[i] *= out[i];
}

size_t LightVisibility::memory() const {
  size_t bytes = 0;
  for (const auto& map : maps_) bytes += map ? map->memory() : 0;
  return bytes;
}

}  // namespace tyndall
