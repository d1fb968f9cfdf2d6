// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "tyndall/guiding/light_view.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// How the map of one light looks at the points that matter, and how far its light gets.
class LightAim {
 public:
  /// `points` where light matters; not empty. The light is no environment.
  LightAim(const Scene& scene, const Light& light, std::span<const Vec3> points);

  /// The narrowest that sees nearly all the points.
  const LightView& view() const { return view_; }
  /// Nothing is known out of the view, though the light may shine there.
  bool is_lit_outside() const { return is_lit_outside_; }
  /// A jump of the distance that makes a difference to the points [scene units].
  float edge_depth() const { return edge_depth_; }
  /// Along a ray of the view, the distance to the first opaque surface that is not the
  /// light itself; infinity if there is none, zero where the light does not shine. `u`
  /// chooses a point of an area light: half shadows are those at about the points'
  /// distance.
  float reach(const Ray& ray, Vec2 u) const;
  /// Optical depth of the proxies along a ray of the view up to distances from the light,
  /// which do not decrease: of the path that the light takes if nothing blocks it.
  void optical_depth(const Ray& ray, std::span<const float> t, std::span<float> out) const;
  /// Nearly all the points are nearer [scene units].
  float range() const { return range_; }

 private:
  std::optional<Ray> leave(const Ray& ray, Vec2 u) const;
  void aim_finite(std::span<const Vec3> points);
  void aim_parallel(const Light& light, std::span<const Vec3> points);

  const Scene* scene_;
  const Light* light_;
  LightView view_ = LightView::around({});
  bool is_lit_outside_ = false;
  Vec3 center_;  // of the light
  float edge_depth_ = 0, range_ = 1;
  float focus_ = 1;   // the points' distance from it
  float beyond_ = 0;  // where parallel rays start, before the view's plane
};

}  // namespace tyndall
