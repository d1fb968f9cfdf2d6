// SPDX-License-Identifier: Apache-2.0
#include "techniques/references.h"

#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>

#include "support/quadrature.h"

namespace tyndall {
namespace {

/// Without long double inside, which costs most of the time.
using Fast = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

double henyey_greenstein(double g, double cos_theta) {
  return (1 - g * g) / (4 * M_PI) / std::pow(1 + g * g - 2 * g * cos_theta, 1.5);
}

double arc(double g, double alpha) {
  if (g < 0) return arc(-g, M_PI) - arc(-g, M_PI - alpha);
  const double ratio = (1 + g) / (1 - g);
  const double angle = std::atan2(ratio * std::sin(alpha / 2), std::cos(alpha / 2));
  return boost::math::ellint_2(std::sqrt(1 - 1 / (ratio * ratio)), angle, Fast()) /
         (2 * M_PI * (1 - g));
}

double azimuth_arc(double g, double alpha, double theta, double phi) {
  // 1 + g^2 - 2 g cos = a - b cos phi, which is proportional to 1 + f^2 - 2 f cos phi for
  // some f: an arc again, of another asymmetry and scale.
  const double a = 1 + g * g - 2 * g * std::cos(alpha) * std::cos(theta);
  const double b = 2 * g * std::sin(alpha) * std::sin(theta);
  const double f = b / (a + std::sqrt(a * a - b * b));
  const double scale = a / (1 + f * f);
  return (1 - g * g) / (1 - f * f) * std::pow(scale, -1.5) * arc(f, phi);
}

double scattered_twice(double g, double alpha, double theta) {
  const double whole = arc(g, M_PI);
  const auto f = [&](double x) {
    return 2 * azimuth_arc(g, alpha, x, M_PI) * (whole - arc(g, x));
  };
  const double peak = g > 0 ? alpha : M_PI - alpha;
  if (peak <= 0 || peak >= theta) return quadrature(f, 0, theta, 1e-6);
  return quadrature(f, 0, peak, 1e-6) + quadrature(f, peak, theta, 1e-6);
}

}  // namespace tyndall
