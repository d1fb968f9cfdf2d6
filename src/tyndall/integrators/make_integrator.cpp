// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tyndall/integrators/integrator.h"
#include "tyndall/integrators/path_tracer.h"

namespace tyndall {

std::unique_ptr<Integrator> make_integrator(const Scene& scene,
                                            const RenderSettings& settings) {
  ConnectionSettings connections =
      connection_settings(settings.integrator, settings.options);
  connections.lit_surfaces =
      std::min(connections.lit_surfaces, std::max(settings.max_depth - 1, 1));
  return std::make_unique<PathTracer>(scene, settings, connections);
}

}  // namespace tyndall
