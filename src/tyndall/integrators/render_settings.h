// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "tyndall/image/filter.h"
#include "tyndall/math/constants.h"
#include "tyndall/math/vec.h"
#include "tyndall/sampling/sampler.h"

namespace tyndall {

/// Which numbers of scattering events in media a path must have to count; surface bounces
/// are free. The default keeps all.
struct ScatteringOrders {
  int min = 0;
  int max = 1 << 30;

  bool contains(int order) const { return min <= order && order <= max; }
};

/// How a scene is to be rendered: what pbrt's Integrator, Sampler, Film and PixelFilter
/// say.
struct RenderSettings {
  std::string integrator = "learned";
  /// Scattering vertices between camera and light, interfaces not counted, as in pbrt-v4.
  int max_depth = 5;
  ScatteringOrders orders;
  Vec2i resolution{1280, 720};
  Vec2i crop_min{0, 0}, crop_max{1280, 720};  ///< [pixels], max exclusive
  FilterSettings filter;
  SamplerKind sampler = SamplerKind::sobol;
  uint32_t samples_per_pixel = 16;
  uint64_t seed = 0;
  std::string output = "tyndall.exr";
  /// What pixels are multiplied by: pbrt-v4's exposure time * iso / 100.
  float imaging_ratio = 1;
  /// Samples and splats with a brighter component, after imaging_ratio, are dimmed to it:
  /// pbrt-v4's maxcomponentvalue. It takes light away.
  float max_component = infinity;
  /// Integrator options by dotted name, as `--set learned.direction=off` gives them.
  std::map<std::string, std::string> options;
};

}  // namespace tyndall
