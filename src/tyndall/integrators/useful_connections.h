// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tyndall/integrators/connection_settings.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// What is left of the connections that were asked for.
struct UsefulConnections {
  ConnectionSettings settings;
  /// A sentence if distances or directions were to be learned, and neither are; else empty.
  std::string why_unlearned;
};

/// The settings less what can gain nothing in the scene: predicted visibility and learned
/// directions where surfaces hide little light from the places that the picture shows
/// (found by a few thousand rays) and the media are homogeneous, lit surfaces where none
/// reflects, and all connections where every light is so far from all that scatters that
/// its distance hardly varies, or there is no light at a finite distance. Then `single` is
/// false.
UsefulConnections useful_connections(const Scene& scene, ConnectionSettings settings);

}  // namespace tyndall
