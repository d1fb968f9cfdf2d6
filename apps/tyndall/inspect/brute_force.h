// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/integrators/connection_leg.h"
#include "tyndall/integrators/vertex.h"

namespace tyndall::app {

/// The light of that index, or else the one that connections of the leg most likely draw.
/// Throws std::invalid_argument if there is no such light, or it is at infinity.
size_t shown_light(ConnectionLeg& leg, const Scene& scene, std::optional<size_t> index);

/// The radiance that a vertex in `medium` scatters of one light, over sigma_s: an estimate
/// from one point of the light.
Rgb scattered_light(const Scene& scene, const Vertex& vertex, const Medium& medium,
                    const Light& light, RandomStream& random);

}  // namespace tyndall::app
