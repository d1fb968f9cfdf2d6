// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/sky_probe.h"

#include <algorithm>

#include "tyndall/integrators/leg_proxy.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

SkyProbe::SkyProbe(const Scene& scene, const Light& light)
    : scene_(&scene),
      light_(&light),
      dims_(!std::ranges::all_of(scene.description().media, &Medium::is_homogeneous)) {}

SkyGuide::Weights SkyProbe::look(Vec3 p, size_t key) const {
  const Medium* medium = dims_ ? medium_at(*scene_, p) : nullptr;
  RandomStream random(hash(uint64_t{3}, key));
  SkyGuide::Weights seen{};
  for (size_t i = 0; i < SkyGuide::strata; ++i) {
    const Vec2 u = random.next_2d();
    const Vec2 corner{static_cast<float>(i % SkyGuide::side),
                      static_cast<float>(i / SkyGuide::side)};
    const std::optional<LightSample> sample =
        light_->sample(p, (corner + u) * (1.0f / SkyGuide::side));
    if (!sample || !(sample->pdf > 0)) continue;
    seen[i] = luminance(sample->L) / sample->pdf * along({p, sample->wi}, medium);
  }
  return seen;
}

float SkyProbe::along(const Ray& ray, const Medium* medium) const {
  if (scene_->is_occluded(ray, infinity)) return 0;
  if (!dims_) return 1;
  Leg leg(*scene_, ray, medium);
  const LegProxy proxy(leg);
  return proxy.is_empty() ? 1 : proxy.transmittance(proxy.t_max());
}

}  // namespace tyndall
