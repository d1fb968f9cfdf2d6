// SPDX-License-Identifier: Apache-2.0
#include "tyndall/sampling/tabulated.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "support/chi_square.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

using Table = std::vector<float>;

TEST(DiscreteDistribution, ChoosesInProportionToWeight) {
  const Table weights{0, 3, 0, 1, 0};
  const DiscreteDistribution d(weights);
  ASSERT_EQ(d.size(), 5u);
  EXPECT_EQ(d.probability(0), 0);
  EXPECT_FLOAT_EQ(d.probability(1), 0.75f);
  EXPECT_EQ(d.probability(2), 0);
  EXPECT_FLOAT_EQ(d.probability(3), 0.25f);
  EXPECT_EQ(d.probability(4), 0);
  EXPECT_EQ(d.sample(0).index, 1u);
  EXPECT_EQ(d.sample(0.7499f).index, 1u);
  EXPECT_EQ(d.sample(0.75f).index, 3u);
  EXPECT_EQ(d.sample(one_minus_epsilon).index, 3u);
  EXPECT_EQ(d.sample(1).index, 3u);
}

TEST(DiscreteDistribution, RemappedNumberIsUniformAgain) {
  const Table weights{1, 5, 2};
  const DiscreteDistribution d(weights);
  const auto draw = [&](Vec2 u) {
    const DiscreteSample s = d.sample(u.x);
    EXPECT_EQ(s.probability, d.probability(s.index));
    return Vec2{(static_cast<float>(s.index) + u.y) / 3, s.u_remapped};
  };
  const auto pdf = [](Vec2 p) {
    return p.x < 1.0f / 3 ? 3 / 8.0 : p.x < 2.0f / 3 ? 15 / 8.0 : 6 / 8.0;
  };
  const ChiSquareResult r = chi_square_square(draw, pdf, 100'000, 1, 12);
  EXPECT_GT(r.p_value, 0.005) << r;
}

TEST(DiscreteDistribution, TreatsZeroWeightsAlike) {
  const Table weights(4, 0.0f);
  const DiscreteDistribution d(weights);
  for (size_t i = 0; i < 4; ++i) EXPECT_FLOAT_EQ(d.probability(i), 0.25f);
  EXPECT_EQ(d.sample(0.6f).index, 2u);
}

TEST(DiscreteDistribution, SurvivesExtremeWeights) {
  const Table weights{1e-30f, 1e30f, 1e-38f};
  const DiscreteDistribution d(weights);
  for (const float u : {0.0f, 0.5f, one_minus_epsilon}) {
    const DiscreteSample s = d.sample(u);
    EXPECT_EQ(s.index, 1u);
    EXPECT_TRUE(s.u_remapped >= 0 && s.u_remapped < 1);
  }
}

TEST(PiecewiseConstant1D, MatchesItsDensity) {
  const Table values{1, 0, 4, 2, 0.5f};
  const PiecewiseConstant1D d(values);
  EXPECT_FLOAT_EQ(d.integral(), 1.5f);
  const ChiSquareResult r =
      chi_square_line([&](float u) { return d.sample(u).x; },
                      [&](double x) { return double{d.pdf(float(x))}; }, 0, 1);
  EXPECT_GT(r.p_value, 0.005) << r;
  EXPECT_NEAR(r.mass, 1, 1e-5);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
  // The mean is the sum of the bins' centres times their shares.
  EXPECT_GT(z_p_value(r.moments[0], (0.1 * 1 + 0.5 * 4 + 0.7 * 2 + 0.9 * 0.5) / 7.5),
            0.005);
}

TEST(PiecewiseConstant1D, SampleAndPdfAndInverseAgreeExactly) {
  RandomStream random(5);
  for (const size_t bins : {1u, 3u, 7u, 1000u}) {
    Table values(bins);
    for (float& v : values) v = random.next_1d() < 0.3f && bins > 1 ? 0 : random.next_1d();
    const PiecewiseConstant1D d(values);
    for (int i = 0; i < 5000; ++i) {
      const float u = i == 0 ? 0 : i == 1 ? one_minus_epsilon : random.next_1d();
      const PiecewiseSample s = d.sample(u);
      ASSERT_TRUE(s.x >= 0 && s.x < 1);
      ASSERT_GT(s.pdf, 0);
      ASSERT_EQ(s.pdf, d.pdf(s.x)) << bins << " " << u;
      // A step of x moves u by pdf times as much.
      ASSERT_NEAR(d.invert(s.x), u, 2e-7f * (1 + s.pdf)) << bins << " " << u;
    }
  }
}

TEST(PiecewiseConstant1D, IsUniformIfAllIsZero) {
  const Table values(3, 0.0f);
  const PiecewiseConstant1D d(values);
  EXPECT_EQ(d.integral(), 0);
  EXPECT_EQ(d.pdf(0.4f), 1);
  EXPECT_FLOAT_EQ(d.sample(0.4f).x, 0.4f);
}

TEST(PiecewiseConstant1D, HasNoDensityOutside) {
  const Table values{1, 2};
  const PiecewiseConstant1D d(values);
  EXPECT_EQ(d.pdf(-0.1f), 0);
  EXPECT_EQ(d.pdf(1.1f), 0);
  EXPECT_GT(d.pdf(1), 0);
}

TEST(PiecewiseConstant2D, MatchesItsDensity) {
  const Table values{1, 2, 0,  //
                     5, 0, 1};
  const PiecewiseConstant2D d(values, 3, 2);
  EXPECT_FLOAT_EQ(d.pdf({0.1f, 0.9f}), 5 * 6 / 9.0f);  // row 1, column 0
  EXPECT_FLOAT_EQ(d.pdf({0.5f, 0.1f}), 2 * 6 / 9.0f);
  EXPECT_EQ(d.pdf({0.9f, 0.1f}), 0);
  const ChiSquareResult r = chi_square_square([&](Vec2 u) { return d.sample(u).p; },
                                              [&](Vec2 p) { return double{d.pdf(p)}; });
  EXPECT_GT(r.p_value, 0.005) << r;
  EXPECT_NEAR(r.mass, 1, 1e-4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
}

TEST(PiecewiseConstant2D, InverseUndoesSample) {
  const Table values{1, 2, 0, 5, 0, 1, 0, 0, 0, 1e-3f, 7, 1};
  const PiecewiseConstant2D d(values, 3, 4);
  RandomStream random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u = random.next_2d();
    const PiecewiseSample2D s = d.sample(u);
    ASSERT_EQ(s.pdf, d.pdf(s.p));
    const Vec2 back = d.invert(s.p);
    ASSERT_NEAR(back.x, u.x, 1e-6f);
    ASSERT_NEAR(back.y, u.y, 1e-6f);
  }
}

}  // namespace
}  // namespace tyndall
