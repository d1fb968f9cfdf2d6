// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/guiding/sky_guide.h"
#include "tyndall/lights/light.h"

namespace tyndall {

/// Draws a direction towards the light from p; towards an environment as the guide says,
/// if there is one. Empty if the light does not reach p.
std::optional<LightSample> sample_light(const Light& light, const SkyGuide* guide, Vec3 p,
                                        Vec2 u);

/// Density with which sample_light() draws the direction wi towards the environment from p
/// [1/sr]; zero for other lights.
float environment_pdf(const Light& light, const SkyGuide* guide, Vec3 p, Vec3 wi);

}  // namespace tyndall
