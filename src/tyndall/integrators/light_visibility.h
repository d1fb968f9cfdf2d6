// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <span>

#include "tyndall/guiding/exposure_grid.h"
#include "tyndall/guiding/optical_depth_map.h"
#include "tyndall/guiding/sky_guide.h"
#include "tyndall/guiding/visibility_map.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

struct LightVisibilitySettings {
  float floor = 0.002f;  ///< least predicted visibility: the price of being wrong
  /// Of all lights together. Bounds memory, 22 bytes each, and time, four rays each at
  /// the edges of shadows.
  size_t texels = size_t{1} << 21;
  int cells = 1 << 12;  ///< of the grid of an environment, 256 rays each
};

/// What each light sees, predicted: one visibility map per light, traced once; for each
/// environment a grid of how much of it a place sees, and where.
///
/// Maps look where camera paths come by: a far light spends its texels on the part of its
/// sky that the scene takes up. Bright lights get finer maps than dim ones.
///
/// Immutable after construction, safe to use from all threads.
class LightVisibility {
 public:
  /// Traces in parallel. Throws nothing but std::bad_alloc.
  LightVisibility(const Scene& scene, const LightVisibilitySettings& settings = {});

  /// Takes over maps, by the index of their light: for tools and tests.
  using Depths = std::map<size_t, OpticalDepthMap>;
  using Maps = std::map<size_t, std::shared_ptr<const VisibilityMap>>;
  using Skies = std::map<size_t, std::shared_ptr<const SkyGuide>>;
  explicit LightVisibility(Maps maps, Skies skies = {})
      : maps_(std::move(maps)), skies_(std::move(skies)) {}

  /// Multiplies each weight by the mean visibility from the light of its two taps, which
  /// are neighbours, as multiply_mixed() does; at most 64 weights.
  /// `footprint` is the angle between neighbouring taps, seen from the light [rad], or
  /// their distance if the light is at infinity.
  void multiply(size_t light, const Ray& ray, std::span<const float> t, float footprint,
                std::span<float> weights) const;
  /// Multiplies each weight by the transmittance of the proxies between its tap and the
  /// light. Does nothing where one homogeneous medium fills the scene: that needs no map.
  void multiply_transmittance(size_t light, const Ray& ray, std::span<const float> t,
                              std::span<float> weights) const;
  const Maps& maps() const { return maps_; }
  /// Whether it is predicted where the light is seen from.
  bool knows(size_t light) const {
    return maps_.find(light) != maps_.end() || exposures_.find(light) != exposures_.end();
  }
  /// Where places see this environment; null if nothing is predicted.
  const SkyGuide* sky(size_t light) const {
    const auto found = skies_.find(light);
    return found != skies_.end() ? found->second.get() : nullptr;
  }
  size_t memory() const;  ///< [bytes]

 private:
  void measure_sky(size_t light, const Scene& scene, std::span<const Vec3> points,
                   const LightVisibilitySettings& settings);

  Depths depths_;
  Maps maps_;  // none for environments
  std::map<size_t, ExposureGrid> exposures_;
  Skies skies_;
};

}  // namespace tyndall
