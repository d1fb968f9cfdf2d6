// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/lights/volume_light.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall {

/// Where a medium emits how much; measured in parallel. Homogeneous media are cut to `box`,
/// others know their own. Empty if nothing glows there.
std::optional<EmissionDistribution> measure_emission(const Medium& medium,
                                                     const Bounds3& box);

/// The light of all media that glow. Homogeneous media lie within the surfaces that have
/// them inside. Empty if there is none with bounds.
std::optional<VolumeLight> make_volume_light(const SceneDescription& description);

}  // namespace tyndall
