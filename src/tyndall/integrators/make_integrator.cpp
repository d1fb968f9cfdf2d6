// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "tyndall/integrators/integrator.h"
#include "tyndall/integrators/path_tracer.h"

namespace tyndall {

std::vector<std::string> integrator_names() {
  return {"volpath", "equiangular", "jis", "learned"};
}

std::unique_ptr<Integrator> make_integrator(const Scene& scene,
                                            const RenderSettings& settings) {
  if (!settings.options.empty())
    throw std::invalid_argument(fmt::format("integrator \"{}\" has no option \"{}\"",
                                            settings.integrator,
                                            settings.options.begin()->first));
  const auto tracer = [&](const ConnectionSettings& connections) {
    return std::make_unique<PathTracer>(scene, settings, connections);
  };
  if (settings.integrator == "volpath") return tracer({});
  if (settings.integrator == "equiangular") return tracer({.single = true});
  if (settings.integrator == "learned")
    return tracer(
        {.single = true,
         .dual = true,
         .min_distance_ratio = 1,
         .visibility = true,
         .lit_surfaces = std::clamp(settings.max_depth - 1, 1, max_lit_surfaces)});
  if (settings.integrator == "jis") return tracer({.single = true, .dual = true});
  throw std::invalid_argument(fmt::format("unknown integrator \"{}\"; there are: {}",
                                          settings.integrator,
                                          fmt::join(integrator_names(), ", ")));
}

}  // namespace tyndall
