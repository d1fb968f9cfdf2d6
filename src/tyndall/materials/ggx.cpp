// SPDX-License-Identifier: Apache-2.0
#include "tyndall/materials/ggx.h"

#include <algorithm>
#include <cmath>

#include "tyndall/sampling/warps.h"

namespace tyndall {

Ggx::Ggx(float alpha_x, float alpha_y)
    : alpha_x_(std::max(alpha_x, 1e-4f)), alpha_y_(std::max(alpha_y, 1e-4f)) {}

bool Ggx::is_smooth(float alpha_x, float alpha_y) {
  return std::max(alpha_x, alpha_y) < 1e-3f;
}

float Ggx::density(Vec3 m) const {
  const float e = sqr(m.x / alpha_x_) + sqr(m.y / alpha_y_) + sqr(m.z);
  return inv_pi / (alpha_x_ * alpha_y_ * sqr(e));
}

float Ggx::slanted_area(Vec3 w) const {
  return std::sqrt(sqr(alpha_x_ * w.x) + sqr(alpha_y_ * w.y) + sqr(w.z));
}

// 1 / (1 + lambda_o + lambda_i) with lambda = (slanted_area / |z| - 1) / 2, times |zo zi|
// above and below, so that nothing is divided by zero at the horizon.
float Ggx::visibility(Vec3 wo, Vec3 wi) const {
  const float zo = magnitude(wo.z), zi = magnitude(wi.z);
  const float denominator = zi * slanted_area(wo) + zo * slanted_area(wi);
  return denominator > 0 ? 2 * zo * zi / denominator : 0;
}

// G1 D |w m| / |z|, with G1 / |z| = 2 / (|z| + slanted_area).
float Ggx::visible_density(Vec3 w, Vec3 m) const {
  return 2 * density(m) * abs_dot(w, m) / (magnitude(w.z) + slanted_area(w));
}

// Stretching the surface by alpha turns the facets into a hemisphere, whose visible part is
// seen from w as a half disk plus a half disk foreshortened by the cosine.
Vec3 Ggx::sample_visible(Vec3 w, Vec2 u) const {
  Vec3 v = normalize({alpha_x_ * w.x, alpha_y_ * w.y, w.z});
  if (w.z < 0) v = -v;
  const float horizontal2 = sqr(v.x) + sqr(v.y);
  const Vec3 t1 =
      horizontal2 > 0 ? Vec3{-v.y, v.x, 0} / std::sqrt(horizontal2) : Vec3{1, 0, 0};
  const Vec3 t2 = cross(v, t1);
  const Vec2 disk = sample_concentric_disk(u);
  const float half_width = safe_sqrt(1 - sqr(disk.x));
  const float y = std::lerp(half_width, disk.y, 0.5f * (1 + v.z));
  const Vec3 m = t1 * disk.x + t2 * y + v * safe_sqrt(1 - sqr(disk.x) - sqr(y));
  return normalize({alpha_x_ * m.x, alpha_y_ * m.y, std::max(m.z, 1e-6f)});
}

}  // namespace tyndall
