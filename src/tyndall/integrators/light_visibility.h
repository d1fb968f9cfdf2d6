// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tyndall/guiding/visibility_map.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// What each finite light sees, predicted: one visibility map per light, traced once.
///
/// Immutable after construction, safe to use from all threads.
class LightVisibility {
 public:
  /// Maps of all lights together take at most `max_bytes`: many lights get coarser maps.
  /// Traces in parallel.
  LightVisibility(const Scene& scene, size_t max_bytes, float floor);

  /// Multiplies weights[i] by the visibility of ray.at(t[i]) from the light. `footprint` is
  /// the angle between neighbouring points, seen from the light [rad].
  void multiply(size_t light, const Ray& ray, std::span<const float> t, float footprint,
                std::span<float> weights) const;
  size_t memory() const;  ///< [bytes]

 private:
  std::vector<std::unique_ptr<const VisibilityMap>> maps_;  // null for lights at infinity
};

}  // namespace tyndall
