// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/inspect/brute_force.h"

#include <stdexcept>

namespace tyndall::app {

size_t shown_light(ConnectionLeg& leg, const Scene& scene, std::optional<size_t> index) {
  const size_t lights = scene.lights().size();
  size_t shown = index.value_or(0);
  for (size_t i = 1; !index && i < lights; ++i)
    if (leg.light_probability(i) > leg.light_probability(shown)) shown = i;
  if (shown >= lights || !leg.pivot(shown))
    throw std::invalid_argument("there is no finite light of this number");
  return shown;
}

Rgb scattered_light(const Scene& scene, const Vertex& vertex, const Medium& medium,
                    const Light& light, RandomStream& random) {
  const std::optional<LightSample> sample = light.sample(vertex.p(), random.next_2d());
  if (!sample || !(sample->pdf > 0)) return Rgb();
  const Ray shadow = vertex.spawn(sample->wi);
  const float t_max = sample->distance * 0.9999f;
  if (scene.is_occluded(shadow, t_max)) return Rgb();
  const Rgb T = transmittance(scene, shadow, t_max, &medium, random);
  return vertex.eval(sample->wi) * T * sample->L / sample->pdf;
}

}  // namespace tyndall::app
