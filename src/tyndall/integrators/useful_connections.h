// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/integrators/connection_settings.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// The settings less what can gain nothing in the scene: predicted visibility and lit
/// surfaces where no surface hides light, and all connections where every light is so far
/// from all that scatters that its distance hardly varies, or there is no light at a finite
/// distance. Then `single` is false.
ConnectionSettings useful_connections(const Scene& scene, ConnectionSettings settings);

}  // namespace tyndall
