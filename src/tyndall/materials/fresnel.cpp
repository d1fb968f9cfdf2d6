// SPDX-License-Identifier: Apache-2.0
#include "tyndall/materials/fresnel.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

float dielectric_fresnel(float cos_i, float eta) {
  if (cos_i < 0) {
    eta = 1 / eta;
    cos_i = -cos_i;
  }
  cos_i = std::min(cos_i, 1.0f);
  const float sin2_t = (1 - sqr(cos_i)) / sqr(eta);
  if (sin2_t >= 1) return 1;
  const float cos_t = safe_sqrt(1 - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (sqr(parallel) + sqr(perpendicular));
}

// With a + i b = sqrt((eta + i k)^2 - sin^2), the perpendicular amplitude is
//   (cos - (a + i b)) / (cos + (a + i b)),
// and the parallel one is that times (a + i b - sin^2 / cos) / (a + i b + sin^2 / cos).
float conductor_fresnel(float cos_i, float eta, float k) {
  const float cosine = std::clamp(cos_i, 1e-6f, 1.0f);  // 0/0 at the horizon if eta is 1
  const float cos2 = sqr(cosine), sin2 = 1 - cos2;
  const float difference = sqr(eta) - sqr(k) - sin2;
  const float a2_plus_b2 = std::sqrt(sqr(difference) + sqr(2 * eta * k));
  const float a = safe_sqrt(0.5f * (a2_plus_b2 + difference));
  const float even = a2_plus_b2 + cos2, odd = 2 * a * cosine;
  const float perpendicular = (even - odd) / (even + odd);
  const float even_p = cos2 * a2_plus_b2 + sqr(sin2), odd_p = odd * sin2;
  const float parallel = perpendicular * (even_p - odd_p) / (even_p + odd_p);
  return 0.5f * (perpendicular + parallel);
}

std::optional<Refraction> refract(Vec3 wo, Vec3 n, float eta) {
  float cos_o = dot(wo, n);
  if (cos_o < 0) {
    eta = 1 / eta;
    cos_o = -cos_o;
    n = -n;
  }
  const float sin2_i = std::max(0.0f, 1 - sqr(cos_o)) / sqr(eta);
  if (sin2_i >= 1) return std::nullopt;
  const float cos_i = safe_sqrt(1 - sin2_i);
  return Refraction{normalize(wo * (-1 / eta) + n * (cos_o / eta - cos_i)), eta};
}

}  // namespace tyndall
