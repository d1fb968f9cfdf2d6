// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/path_tracer.h"

#include <algorithm>

namespace tyndall {

PathTracer::PathTracer(const Scene& scene, const RenderSettings& settings,
                       const ConnectionSettings& connections)
    : scene_(scene),
      rules_{
          .max_depth = settings.max_depth,
          .orders = settings.orders,
          .is_chromatic = !std::ranges::all_of(scene.description().media, &Medium::is_grey),
          .connections = nullptr} {
  if (!connections.single) return;
  connections_.emplace(scene, connections);
  // Without finite lights there is nothing to connect to.
  if (connections_->light_choice().has_finite_lights()) rules_.connections = &*connections_;
}

PathSample PathTracer::Li(const Ray& ray, Sampler& sampler) const {
  Path path(scene_, rules_, ray, sampler);
  do {
    Leg leg(scene_, path.ray(), path.medium());
    path.connect(leg);
    if (!path.advance(leg)) break;
    path.estimate_direct();
  } while (path.scatter());
  return path.result();
}

}  // namespace tyndall
