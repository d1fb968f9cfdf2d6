// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/integrators/connection_settings.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// The settings less what can gain nothing in the scene: predicted visibility and learned
/// directions where surfaces hide little light from the places that the picture shows
/// (found by a few thousand rays) and the media are homogeneous, lit surfaces where none
/// reflects, and all connections where every light is so far from all that scatters that
/// its distance hardly varies, or there is no light at a finite distance. Then `single` is
/// false.
ConnectionSettings useful_connections(const Scene& scene, ConnectionSettings settings);

}  // namespace tyndall
