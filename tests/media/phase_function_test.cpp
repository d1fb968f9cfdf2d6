// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/phase_function.h"

#include <gtest/gtest.h>

#include "support/chi_square.h"
#include "tyndall/math/vec.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

struct PhaseCase {
  const char* name;
  PhaseFunction phase;
  double concentration = 0;  // of the cells about the peak
};

void PrintTo(const PhaseCase& c, std::ostream* out) { *out << c.name; }

// Values at equidistant cosines: with zeros at an end and in the middle, and a strong
// slope.
TabulatedPhase tabulated() {
  constexpr float values[] = {0, 1, 3, 0, 0, 2, 8};
  return TabulatedPhase(values);
}

const PhaseCase cases[] = {
    {"isotropic", IsotropicPhase{}},
    {"hg_back_0.9", HenyeyGreenstein(-0.9f), 0},
    {"hg_back_0.5", HenyeyGreenstein(-0.5f)},
    {"hg_back_1e-4", HenyeyGreenstein(-1e-4f)},
    {"hg_0", HenyeyGreenstein(0)},
    {"hg_1e-4", HenyeyGreenstein(1e-4f)},
    {"hg_0.5", HenyeyGreenstein(0.5f)},
    {"hg_0.9", HenyeyGreenstein(0.9f), 8},
    {"hg_0.99", HenyeyGreenstein(0.99f), 14},
    {"two_lobes", TwoLobePhase(HenyeyGreenstein(0.8f), HenyeyGreenstein(-0.3f), 0.7f), 4},
    {"one_of_two_lobes", TwoLobePhase(HenyeyGreenstein(0.5f), HenyeyGreenstein(-0.3f), 1)},
    {"rayleigh", RayleighPhase{}},
    {"tabulated", tabulated()},
};
constexpr int case_count = static_cast<int>(std::size(cases));

class PhaseFunctionTest : public testing::TestWithParam<PhaseCase> {};

INSTANTIATE_TEST_SUITE_P(All, PhaseFunctionTest, testing::ValuesIn(cases));

TEST_P(PhaseFunctionTest, SamplesFollowTheirPdf) {
  const PhaseFunction& phase = GetParam().phase;
  const Vec3 wo = normalize({0.3f, -0.5f, 0.8f});
  const SphereCells cells{.pole = -wo, .concentration = GetParam().concentration};
  const ChiSquareResult r = chi_square_sphere(
      [&](Vec2 u) { return phase.sample(wo, u)->wi; },
      [&](Vec3 wi) { return double{phase.pdf(wo, wi)}; }, 100'000, 1, cells);
  EXPECT_GT(r.p_value, sidak(0.01, case_count)) << r;
  EXPECT_NEAR(r.mass, 1, 1e-4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
}

// The chi-square test cannot see a wrong sign shared by sample() and pdf(); the mean can.
TEST_P(PhaseFunctionTest, MeanCosineIsAsStated) {
  const PhaseFunction& phase = GetParam().phase;
  const Vec3 wo{0, 0, 1};
  double mean = 0;
  const int n = 1 << 16;
  for (int i = 0; i < n; ++i) {
    const Vec2 u{(static_cast<float>(i) + 0.5f) / n, 0.25f};
    mean += static_cast<double>(-dot(wo, phase.sample(wo, u)->wi)) / n;
  }
  EXPECT_NEAR(mean, double{phase.mean_cosine()}, 1e-4);
}

TEST_P(PhaseFunctionTest, SampleCarriesItsValueAndPdf) {
  const PhaseFunction& phase = GetParam().phase;
  RandomStream rng(3);
  const Vec3 wo = normalize({-0.2f, 0.9f, -0.4f});
  for (int i = 0; i < 1000; ++i) {
    const PhaseSample s = *phase.sample(wo, rng.next_2d());
    EXPECT_NEAR(length(s.wi), 1, 1e-5);
    EXPECT_EQ(s.value, phase.eval(wo, s.wi));
    EXPECT_EQ(s.pdf, phase.pdf(wo, s.wi));
  }
}

TEST_P(PhaseFunctionTest, IsFiniteAtTheEndsOfTheUnitSquare) {
  const PhaseFunction& phase = GetParam().phase;
  for (const float x : {0.0f, 0x1p-24f, 0.5f, one_minus_epsilon})
    for (const float y : {0.0f, one_minus_epsilon}) {
      const PhaseSample s = *phase.sample({0, 0, -1}, {x, y});
      EXPECT_TRUE(is_finite(s.wi));
      EXPECT_GE(s.pdf, 0);
      EXPECT_TRUE(std::isfinite(s.pdf));
    }
}

// [HG41] at three angles by hand: g = 0.5, forward (1 - g^2) / (4 pi (1 - g)^3).
TEST(HenyeyGreensteinTest, MatchesHandComputedValues) {
  const HenyeyGreenstein phase(0.5f);
  const Vec3 wo{0, 0, 1};
  EXPECT_NEAR(phase.eval(wo, {0, 0, -1}), 6.0f * inv_4pi, 1e-5);
  EXPECT_NEAR(phase.eval(wo, {0, 0, 1}), 0.75f / 3.375f * inv_4pi, 1e-6);
  EXPECT_NEAR(phase.eval(wo, {1, 0, 0}), 0.75f / 1.3975424f * inv_4pi, 1e-6);
}

TEST(RayleighPhaseTest, MatchesHandComputedValues) {
  const RayleighPhase phase;
  EXPECT_FLOAT_EQ(phase.eval({0, 0, 1}, {0, 0, 1}), 1.5f * inv_4pi);
  EXPECT_FLOAT_EQ(phase.eval({0, 0, 1}, {1, 0, 0}), 0.75f * inv_4pi);
}

// A straight line from zero (back) to its maximum (on): p = (1 + cos) / (4 pi), mean 1/3.
TEST(TabulatedPhaseTest, MatchesHandComputedValues) {
  constexpr float values[] = {0, 7};
  const TabulatedPhase phase(values);
  EXPECT_FLOAT_EQ(phase.eval({0, 0, 1}, {0, 0, -1}), 2 * inv_4pi);
  EXPECT_FLOAT_EQ(phase.eval({0, 0, 1}, {1, 0, 0}), inv_4pi);
  EXPECT_FLOAT_EQ(phase.mean_cosine(), 1.0f / 3);
}

}  // namespace
}  // namespace tyndall
