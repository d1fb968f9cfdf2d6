// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/scene/scene.h"

namespace tyndall {

/// Measures how much of an environment light gets to a point, by rays. Safe to use from all
/// threads.
class SkyProbe {
 public:
  SkyProbe(const Scene& scene, const Light& light, int rays);

  /// Luminance over all directions, as far as surfaces do not hide it, and media, where
  /// they vary, let it through by their proxies. Points inside surfaces see what they see.
  /// `key` chooses the rays.
  float exposure(Vec3 p, size_t key) const;

 private:
  float along(const Ray& ray, const Medium* medium) const;

  const Scene* scene_;
  const Light* light_;
  int rays_;
  bool dims_;
};

}  // namespace tyndall
