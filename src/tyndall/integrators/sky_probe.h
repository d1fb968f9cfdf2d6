// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/guiding/sky_guide.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// Measures how much of an environment light gets to a point, and from where, by rays. Safe
/// to use from all threads.
class SkyProbe {
 public:
  SkyProbe(const Scene& scene, const Light& light);

  /// Luminance through each stratum of what the light's sampling starts from, as far as
  /// surfaces do not hide it, and media, where they vary, let it through by their proxies.
  /// One ray each; `key` chooses them. Points inside surfaces see what they see.
  SkyGuide::Weights look(Vec3 p, size_t key) const;

 private:
  float along(const Ray& ray, const Medium* medium) const;

  const Scene* scene_;
  const Light* light_;
  bool dims_;
};

}  // namespace tyndall
