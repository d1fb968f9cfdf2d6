// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/sky_probe.h"

#include <algorithm>

#include "tyndall/integrators/leg_proxy.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

SkyProbe::SkyProbe(const Scene& scene, const Light& light, int rays)
    : scene_(&scene),
      light_(&light),
      rays_(rays),
      dims_(!std::ranges::all_of(scene.description().media, &Medium::is_homogeneous)) {}

float SkyProbe::exposure(Vec3 p, size_t key) const {
  const Medium* medium = dims_ ? medium_at(*scene_, p) : nullptr;
  RandomStream random(hash(uint64_t{3}, key));
  float sum = 0;
  for (int i = 0; i < rays_; ++i) {
    const Vec2 u = random.next_2d();
    const Vec2 stratified{(static_cast<float>(i) + u.x) / static_cast<float>(rays_), u.y};
    const std::optional<LightSample> sample = light_->sample(p, stratified);
    if (!sample || !(sample->pdf > 0)) continue;
    sum += luminance(sample->L) / sample->pdf * along({p, sample->wi}, medium);
  }
  return sum;
}

float SkyProbe::along(const Ray& ray, const Medium* medium) const {
  if (scene_->is_occluded(ray, infinity)) return 0;
  if (!dims_) return 1;
  Leg leg(*scene_, ray, medium);
  const LegProxy proxy(leg);
  return proxy.is_empty() ? 1 : proxy.transmittance(proxy.t_max());
}

}  // namespace tyndall
