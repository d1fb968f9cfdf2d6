// SPDX-License-Identifier: Apache-2.0
#include "support/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/statistical_tests.h"

namespace tyndall {
namespace {

// Directions in proportion to exp(k z) (von Mises-Fisher).
std::optional<Vec3> sample_lobe(double k, Vec2 u) {
  const double x = double{u.x};
  const double one_minus_z = -std::log(x + (1 - x) * std::exp(-2 * k)) / k;
  const double r = std::sqrt(one_minus_z * (2 - one_minus_z));
  const double phi = 2 * std::numbers::pi * double{u.y};
  return Vec3{static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
              static_cast<float>(1 - one_minus_z)};
}
double lobe_pdf(double k, Vec3 w) {
  return k * std::exp(k * (double{w.z} - 1)) / (2 * std::numbers::pi * -std::expm1(-2 * k));
}

TEST(ChiSquare, AcceptsARightDensity) {
  for (const double k : {0.5, 5.0, 40.0}) {
    const ChiSquareResult r = chi_square_sphere([k](Vec2 u) { return sample_lobe(k, u); },
                                                [k](Vec3 w) { return lobe_pdf(k, w); });
    EXPECT_GT(r.p_value, sidak(0.01, 3)) << r;
    EXPECT_NEAR(r.mass, 1, 1e-4);
    EXPECT_EQ(r.samples_of_zero_pdf, 0);
    EXPECT_EQ(r.missing, 0);
    EXPECT_GT(z_p_value(r.moments[2], 1 / std::tanh(k) - 1 / k), 1e-3);
  }
}

TEST(ChiSquare, SeesANarrowPeakThroughConcentratedRings) {
  const double k = 1e4;
  const SphereCells cells{.pole = {0, 0, 1}, .concentration = 14};
  const auto draw = [k](Vec2 u) { return sample_lobe(k, u); };
  const ChiSquareResult right = chi_square_sphere(
      draw, [k](Vec3 w) { return lobe_pdf(k, w); }, 200'000, 1, cells);
  EXPECT_GT(right.p_value, 0.003) << right;
  EXPECT_GT(right.degrees_of_freedom, 100);
  const ChiSquareResult wrong = chi_square_sphere(
      draw, [k](Vec3 w) { return lobe_pdf(1.05 * k, w); }, 200'000, 1, cells);
  EXPECT_LT(wrong.p_value, 1e-6) << wrong;
}

TEST(ChiSquare, RejectsAWrongDensity) {
  const ChiSquareResult r = chi_square_sphere([](Vec2 u) { return sample_lobe(5, u); },
                                              [](Vec3 w) { return lobe_pdf(5.2, w); });
  EXPECT_LT(r.p_value, 1e-6) << r;
}

TEST(ChiSquare, RejectsAWrongAzimuth) {
  const auto flipped = [](Vec2 u) {
    const Vec3 w = *sample_lobe(2, {u.x, u.y});
    return Vec3{w.x, magnitude(w.y), w.z};
  };
  const ChiSquareResult r =
      chi_square_sphere(flipped, [](Vec3 w) { return lobe_pdf(2, w); });
  EXPECT_LT(r.p_value, 1e-6);
}

TEST(ChiSquare, CountsSamplesThatTheDensityDenies) {
  const auto everywhere = [](Vec2 u) {
    return spherical_direction(1 - 2 * u.x, 2 * pi * u.y);
  };
  const auto upper = [](Vec3 w) { return w.z > 0 ? double{inv_pi} / 2 : 0.0; };
  const ChiSquareResult r = chi_square_sphere(everywhere, upper, 10'000);
  EXPECT_NEAR(r.mass, 1, 1e-4);
  EXPECT_NEAR(static_cast<double>(r.samples_in_empty_cells), 5000, 250);
  EXPECT_EQ(r.samples_in_empty_cells, r.samples_of_zero_pdf);
  EXPECT_LT(r.p_value, 1e-6);
}

TEST(ChiSquare, EmptySamplesMustMatchTheMissingMass) {
  const auto half = [](double loss) {
    return [loss](float u) -> std::optional<float> {
      if (double{u} < loss) return std::nullopt;
      return static_cast<float>((double{u} - loss) / (1 - loss));
    };
  };
  const auto pdf = [](double) { return 0.7; };
  const ChiSquareResult right = chi_square_line(half(0.3), pdf, 0, 1);
  EXPECT_GT(right.p_value, 0.003) << right;
  EXPECT_NEAR(right.mass, 0.7, 1e-6);
  EXPECT_LT(chi_square_line(half(0.29), pdf, 0, 1).p_value, 1e-6);
}

TEST(ChiSquare, LineRejectsAWrongRate) {
  const auto draw = [](float u) { return -std::log1p(-u) / 3; };
  const auto pdf = [](double k) { return [k](double x) { return k * std::exp(-k * x); }; };
  EXPECT_GT(chi_square_line(draw, pdf(3), 0, 3).p_value, 0.003);
  EXPECT_LT(chi_square_line(draw, pdf(3.1), 0, 3).p_value, 1e-6);
}

TEST(ChiSquare, SquareKeepsItsAxesApart) {
  const auto draw = [](Vec2 u) { return Vec2{std::sqrt(u.x), u.y}; };
  const auto right = [](Vec2 p) { return 2 * double{p.x}; };
  const auto swapped = [](Vec2 p) { return 2 * double{p.y}; };
  const ChiSquareResult r = chi_square_square(draw, right);
  EXPECT_GT(r.p_value, 0.003) << r;
  EXPECT_GT(z_p_value(r.moments[0], 2.0 / 3), 0.003);
  EXPECT_LT(chi_square_square(draw, swapped).p_value, 1e-6);
}

TEST(ChiSquare, HasNoOpinionWithoutCells) {
  const auto point = [](float) { return 0.5f; };
  EXPECT_TRUE(std::isnan(chi_square_line(
                             point, [](double) { return 1.0; }, 0, 1, 100, 1, 1)
                             .p_value));
}

TEST(ChiSquare, PValuesOfTrueHypothesesAreUniform) {
  std::vector<double> p;
  for (uint64_t seed = 0; seed < 200; ++seed)
    p.push_back(chi_square_line([](float u) { return std::sqrt(u); },
                                [](double x) { return 2 * x; }, 0, 1, 2000, seed, 64)
                    .p_value);
  EXPECT_GT(uniformity_p_value(p), 0.003);
}

}  // namespace
}  // namespace tyndall
