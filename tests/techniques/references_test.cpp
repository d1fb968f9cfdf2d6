// SPDX-License-Identifier: Apache-2.0
#include "techniques/references.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/quadrature.h"

namespace tyndall {
namespace {

constexpr double asymmetries[] = {-0.9, -0.3, 1e-4, 0.2, 0.75, 0.99};

TEST(References, ArcIsTheIntegralOfThePhaseFunction) {
  for (const double g : asymmetries)
    for (const double alpha : {0.01, 0.5, 2.0, 3.1}) {
      const double expected =
          quadrature([&](double u) { return henyey_greenstein(g, std::cos(u)); }, 0, alpha);
      EXPECT_NEAR(arc(g, alpha) / expected, 1, 1e-8) << g << " " << alpha;
    }
}

TEST(References, AzimuthArcIsTheIntegralOfThePhaseFunction) {
  for (const double g : asymmetries)
    for (const double theta : {0.3, 1.5, 2.9}) {
      const double alpha = 0.8, end = 2.5;
      const auto f = [&](double phi) {
        return henyey_greenstein(g, std::cos(alpha) * std::cos(theta) +
                                        std::sin(alpha) * std::sin(theta) * std::cos(phi));
      };
      EXPECT_NEAR(azimuth_arc(g, alpha, theta, end) / quadrature(f, 0, end), 1, 1e-7)
          << g << " " << theta;
    }
}

TEST(References, ScatteredTwiceIsClosedInIsotropicMedia) {
  for (const double alpha : {0.0, 1.0, 3.0})
    EXPECT_NEAR(scattered_twice(1e-9, alpha, M_PI),
                std::pow(M_PI, 3) / std::pow(4 * M_PI, 2), 1e-6);
}

}  // namespace
}  // namespace tyndall
