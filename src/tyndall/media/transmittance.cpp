// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/transmittance.h"

#include <cmath>

#include "tyndall/media/ratio_tracking.h"
#include "tyndall/media/ray_marching.h"
#include "tyndall/media/tracking.h"

namespace tyndall {
namespace {

Rgb estimate(const HomogeneousMedium& medium, const Ray& ray, float t_max,
             RandomStream& /*rng*/, TransmittanceMethod /*method*/) {
  const Rgb depth = optical_depth(medium.at(ray.o).sigma_t(), t_max);
  return is_grey(depth) ? Rgb(std::exp(-depth.r)) : exp(-1 * depth);
}

template <typename M>
Rgb estimate(const M& medium, const Ray& ray, float t_max, RandomStream& rng,
             TransmittanceMethod method) {
  switch (method) {
    case TransmittanceMethod::ratio_tracking:
      return ratio_tracking(medium, ray, t_max, rng);
    case TransmittanceMethod::residual_ratio_tracking:
      return residual_ratio_tracking(medium, ray, t_max, rng);
    case TransmittanceMethod::ray_marching:
      return unbiased_ray_marching(medium, ray, t_max, rng);
  }
  return Rgb(0);
}

// Independent of each other, so that the product is unbiased, and exact where all are.
Rgb estimate(const OverlappingMedia& media, const Ray& ray, float t_max, RandomStream& rng,
             TransmittanceMethod method) {
  Rgb product(1);
  for (const SingleMedium& part : media.parts()) {
    product *= std::visit(
        [&](const auto& m) { return estimate(m, ray, t_max, rng, method); }, part);
    if (is_black(product)) break;
  }
  return product;
}

}  // namespace

Rgb estimate_transmittance(const Medium& medium, const Ray& ray, float t_max,
                           RandomStream& rng, TransmittanceMethod method) {
  return medium.visit([&](const auto& m) { return estimate(m, ray, t_max, rng, method); });
}

}  // namespace tyndall
