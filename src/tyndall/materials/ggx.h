// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/vec.h"

namespace tyndall {

/// The distribution of microfacet normals called GGX or Trowbridge-Reitz, with the masking
/// of Smith [Walter07], [Heitz14]. Directions are in the frame of the surface, z along its
/// normal; they may lie on either side, the normals of facets have z > 0.
class Ggx {
 public:
  /// Roughness of each axis. Values so small that float cannot resolve the lobe are raised.
  Ggx(float alpha_x, float alpha_y);

  /// So smooth that it is treated as a mirror, as in pbrt-v4.
  static bool is_smooth(float alpha_x, float alpha_y);

  /// Density of facet area over the normal `m`, per area of the surface [1/sr].
  float density(Vec3 m) const;
  /// The share of facets that are neither masked from wo nor shadowed from wi, heights of
  /// facets correlated.
  float visibility(Vec3 wo, Vec3 wi) const;
  /// Density of sample_visible() [1/sr].
  float visible_density(Vec3 w, Vec3 m) const;
  /// Draws a normal in proportion to the facet area that `w` sees [Heitz18].
  Vec3 sample_visible(Vec3 w, Vec2 u) const;

 private:
  /// |w.z| times (1 + 2 lambda): the projected area of all facets, front and back.
  float slanted_area(Vec3 w) const;

  float alpha_x_, alpha_y_;
};

}  // namespace tyndall
