// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/sky_sampling.h"

namespace tyndall {

std::optional<LightSample> sample_light(const Light& light, const SkyGuide* guide, Vec3 p,
                                        Vec2 u) {
  if (!guide) return light.sample(p, u);
  std::optional<LightSample> sample = light.sample(p, guide->sample(p, u));
  if (sample) sample->pdf = environment_pdf(light, guide, p, sample->wi);
  return sample;
}

float environment_pdf(const Light& light, const SkyGuide* guide, Vec3 p, Vec3 wi) {
  const float pdf = light.pdf(wi);
  return guide && pdf > 0 ? pdf * guide->pdf(p, light.invert(wi)) : pdf;
}

}  // namespace tyndall
