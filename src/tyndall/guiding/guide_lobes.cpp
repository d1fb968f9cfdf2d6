// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/guide_lobes.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

// The mean direction of a component: over four points that have its mean and covariance.
Vec3 mean_direction(const GaussianComponent& c, const LightSquare& square) {
  const float factor_xx = std::sqrt(c.covariance.xx);
  const float factor_yx = c.covariance.xy / factor_xx;
  const float factor_yy = std::sqrt(c.covariance.determinant() / c.covariance.xx);
  constexpr float root2 = 1.41421356f;
  Vec3 sum;
  for (const float sign : {-root2, root2})
    for (const Vec2 step : {Vec2{factor_xx, factor_yx}, Vec2{0, factor_yy}}) {
      const Vec2 p = c.mean + step * sign;
      sum += square.direction({std::clamp(p.x, 0.0f, 1.0f), std::clamp(p.y, 0.0f, 1.0f)}).w;
    }
  return sum * 0.25f;
}

}  // namespace

GuideLobes GuideLobes::of(const GaussianMixture& mixture, SquareMeasure measure) {
  GuideLobes lobes;
  const LightSquare square(Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, measure);
  for (int k = 0; k < mixture.size(); ++k) {
    const auto i = static_cast<size_t>(k);
    const Vec3 mean = mean_direction(mixture.component(k), square);
    const float cosine = length(mean);
    const Vec3 axis = cosine > 1e-4f ? mean / cosine : Vec3{0, 0, 1};
    lobes.x[i] = axis.x;
    lobes.y[i] = axis.y;
    lobes.z[i] = axis.z;
    lobes.cosine[i] = std::min(cosine, 1.0f);
  }
  return lobes;
}

GuideLobes::Lanes GuideLobes::phase_factors(Vec3 axis, float g) const {
  Lanes factors;
  for (size_t i = 0; i < factors.size(); ++i) {
    const float own = g * cosine[i];
    const float cos_theta = x[i] * axis.x + y[i] * axis.y + z[i] * axis.z;
    const float base = std::max(1 + own * own - 2 * own * cos_theta, 1e-6f);
    factors[i] = (1 - own * own) / (base * std::sqrt(base));
  }
  return factors;
}

}  // namespace tyndall
