// SPDX-License-Identifier: Apache-2.0
#include "support/statistical_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/cell_integral.h"
#include "support/quadrature.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

TEST(Quadrature, MatchesClosedForms) {
  EXPECT_NEAR(quadrature([](double x) { return std::exp(-x); }, 0,
                         std::numeric_limits<double>::infinity()),
              1, 1e-9);
  EXPECT_NEAR(quadrature([](double x) { return 1 / (1e-6 + x * x); }, -1, 1),
              2e3 * std::atan(1e3), 1e-4);
}

TEST(CellIntegral, FindsPeaksAndJumps) {
  const auto peak = [](double x, double y) {
    return 1e-3 / std::pow(1e-6 + x * x + y * y, 1.5);
  };
  const double a = 1, e = 1e-3;
  const double closed = 4 * std::atan(a * a / (e * std::sqrt(2 * a * a + e * e)));
  EXPECT_NEAR(cell_integral(peak, {-1, 1, -1, 1}), closed, 1e-4);
  const auto disk = [](double x, double y) { return x * x + y * y < 0.3 ? 1.0 : 0.0; };
  double sum = 0;
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j)
      sum += cell_integral(disk, {i / 16.0, (i + 1) / 16.0, j / 16.0, (j + 1) / 16.0});
  EXPECT_NEAR(4 * sum, 0.3 * std::numbers::pi, 5e-5);
}

TEST(CellIntegral, EndsOnWhatHasNoIntegral) {
  const auto pole = [](double x, double y) { return 1 / std::abs(x - 0.713 * y); };
  EXPECT_GT(cell_integral(pole, {0, 1, 0, 1}), 5);
}

TEST(StatisticalTests, SidakSplitsTheLevel) {
  EXPECT_NEAR(1 - std::pow(1 - sidak(0.01, 50), 50), 0.01, 1e-12);
}

TEST(StatisticalTests, ZTestKnowsTheNormalQuantiles) {
  EXPECT_NEAR(z_p_value(1.959963985, 1, 0), 0.05, 1e-8);
  EXPECT_NEAR(z_p_value(-1.959963985, 1, 0), 0.05, 1e-8);
  EXPECT_EQ(z_p_value(1, 0, 1), 1);
  EXPECT_EQ(z_p_value(1, 0, 1.5), 0);
  EXPECT_EQ(z_p_value(std::nan(""), 1, 0), 0);
}

TEST(StatisticalTests, WelchMatchesAWorkedExample) {
  RunningMoments a, b;
  for (const double x : {1.0, 2.0, 3.0, 4.0}) a.add(x);
  for (const double x : {2.0, 4.0, 6.0, 8.0, 10.0}) b.add(x);
  // t = 3.5 / sqrt(5/12 + 2) = 2.25144 with 5.5196 degrees of freedom.
  EXPECT_NEAR(welch_p_value(a, b), 0.0691, 5e-4);
  EXPECT_EQ(welch_p_value(a, b), welch_p_value(b, a));
}

TEST(StatisticalTests, PValuesOfTrueHypothesesAreUniform) {
  RandomStream random(3);
  std::vector<double> z, welch, uniform;
  for (int trial = 0; trial < 400; ++trial) {
    RunningMoments a, b;
    std::vector<double> values;
    for (int i = 0; i < 200; ++i) {
      a.add(double{random.next_1d()});
      b.add(double{2 * random.next_1d()} - 0.5);
      values.push_back(double{random.next_1d()});
    }
    z.push_back(z_p_value(a, 0.5));
    welch.push_back(welch_p_value(a, b));
    uniform.push_back(uniformity_p_value(values));
  }
  EXPECT_GT(uniformity_p_value(z), 0.003);
  EXPECT_GT(uniformity_p_value(welch), 0.003);
  EXPECT_GT(uniformity_p_value(uniform), 0.003);
}

TEST(StatisticalTests, UniformityRejectsASquareRoot) {
  RandomStream random(4);
  std::vector<double> values;
  for (int i = 0; i < 200; ++i) values.push_back(std::sqrt(double{random.next_1d()}));
  EXPECT_LT(uniformity_p_value(values), 1e-6);
  values[0] = 1.5;
  EXPECT_EQ(uniformity_p_value(values), 0);
}

}  // namespace
}  // namespace tyndall
