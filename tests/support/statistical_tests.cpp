// SPDX-License-Identifier: Apache-2.0
#include "support/statistical_tests.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <vector>

namespace tyndall {

double sidak(double alpha, int tests) { return -std::expm1(std::log1p(-alpha) / tests); }

double z_p_value(double mean, double standard_error, double expected) {
  if (!(standard_error > 0)) return mean == expected ? 1 : 0;
  const double z = std::abs(mean - expected) / standard_error;
  if (!std::isfinite(z)) return 0;
  return 2 * boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

double z_p_value(const RunningMoments& samples, double expected) {
  return z_p_value(samples.mean(), samples.standard_error(), expected);
}

double welch_p_value(const RunningMoments& a, const RunningMoments& b) {
  const double va = a.variance() / static_cast<double>(a.count());
  const double vb = b.variance() / static_cast<double>(b.count());
  if (!(va + vb > 0)) return a.mean() == b.mean() ? 1 : 0;
  const double t = std::abs(a.mean() - b.mean()) / std::sqrt(va + vb);
  if (!std::isfinite(t)) return 0;
  const double degrees_of_freedom = (va + vb) * (va + vb) /
                                    (va * va / static_cast<double>(a.count() - 1) +
                                     vb * vb / static_cast<double>(b.count() - 1));
  const boost::math::students_t distribution(degrees_of_freedom);
  return 2 * boost::math::cdf(boost::math::complement(distribution, t));
}

double uniformity_p_value(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  if (sorted.empty()) return 1;
  for (const double x : sorted)
    if (!(x >= 0 && x <= 1)) return 0;
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<double>(sorted.size());
  double distance = 0;
  for (size_t i = 0; i < sorted.size(); ++i) {
    const auto below = static_cast<double>(i);
    distance = std::max({distance, (below + 1) / n - sorted[i], sorted[i] - below / n});
  }
  const double lambda = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
  if (lambda < 0.2) return 1;  // where the alternating series converges slowly to one
  double p = 0;
  for (int k = 1; k <= 100; ++k) {
    const double term = 2 * std::exp(-2 * k * k * lambda * lambda);
    p += k % 2 == 1 ? term : -term;
  }
  return std::clamp(p, 0.0, 1.0);
}

}  // namespace tyndall
