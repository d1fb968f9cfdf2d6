// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/gaussian_mixture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "guiding/mixtures.h"
#include "support/cell_integral.h"
#include "support/chi_square.h"
#include "tyndall/guiding/vector_exp.h"
#include "tyndall/math/statistics.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

TEST(VectorExpTest, RelativeErrorIsAsDocumented) {
  double worst = 0;
  for (int i = 0; i <= 1'000'000; ++i) {
    const float x = -80 * static_cast<float>(i) / 1'000'000;
    const double exact = std::exp(static_cast<double>(x));
    worst = std::max(worst, std::abs(exp_nonpositive(x) / exact - 1));
  }
  EXPECT_LT(worst, 2e-7);
  EXPECT_EQ(exp_nonpositive(0), 1);
}

TEST(VectorExpTest, StaysPositiveAndNormalFarOut) {
  for (const float x : {-80.0f, -81.0f, -1e3f, -1e30f, -infinity})
    EXPECT_EQ(exp_nonpositive(x), exp_nonpositive(-80));
  EXPECT_GT(exp_nonpositive(-80), 1e-35f);
}

class GaussianMixtureTest : public testing::TestWithParam<NamedMixture> {
 protected:
  GaussianMixture mixture{GetParam().components};
};

INSTANTIATE_TEST_SUITE_P(Examples, GaussianMixtureTest,
                         testing::ValuesIn(example_mixtures()),
                         [](const auto& example) { return example.param.name; });

TEST_P(GaussianMixtureTest, SamplesFollowTheDensity) {
  const ChiSquareResult r = chi_square_square(
      [&](Vec2 u) -> std::optional<Vec2> {
        const auto s = mixture.sample(u);
        if (!s) return std::nullopt;
        return s->p;
      },
      [&](Vec2 p) { return static_cast<double>(mixture.pdf(p)); });

  EXPECT_GT(r.p_value, sidak(0.01, 7)) << r;
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
  EXPECT_NEAR(r.mass, static_cast<double>(mixture.inside_mass()), 2e-4);
}

// A wrong sign shared by sample() and pdf() is seen by none of the above.
TEST_P(GaussianMixtureTest, FirstMomentsAreTheIntegralsOfTheFormula) {
  const auto density = [&](double x, double y) {
    if (GetParam().components.empty()) return 1.0;
    double total = 0, sum = 0;
    for (const GaussianComponent& c : GetParam().components) {
      const double xx = c.covariance.xx, xy = c.covariance.xy, yy = c.covariance.yy;
      const double det = xx * yy - xy * xy, dx = x - c.mean.x, dy = y - c.mean.y;
      const double q = (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / det;
      total += c.weight;
      sum += c.weight * std::exp(-q / 2) / (2 * M_PI * std::sqrt(det));
    }
    return sum / total;
  };
  const Cell square{0, 1, 0, 1};
  const double mean_x =
      cell_integral([&](double x, double y) { return x * density(x, y); }, square);
  const double mean_xy =
      cell_integral([&](double x, double y) { return x * y * density(x, y); }, square);

  RunningMoments x, xy;
  RandomStream random(7);
  for (int i = 0; i < 100'000; ++i) {
    const auto s = mixture.sample(random.next_2d());
    x.add(s ? s->p.x : 0);
    xy.add(s ? s->p.x * s->p.y : 0);
    if (s) {
      ASSERT_NEAR(s->pdf, density(s->p.x, s->p.y), 2e-4 * s->pdf);
      ASSERT_EQ(s->pdf, mixture.pdf(s->p));
    }
  }
  EXPECT_GT(z_p_value(x, mean_x), sidak(0.01, 14));
  EXPECT_GT(z_p_value(xy, mean_xy), sidak(0.01, 14));
}

TEST_P(GaussianMixtureTest, ComponentsComeBackAsTheyWereGiven) {
  float total = 0;
  for (const GaussianComponent& c : GetParam().components) total += c.weight;
  ASSERT_EQ(mixture.size(), static_cast<int>(GetParam().components.size()));
  for (int k = 0; k < mixture.size(); ++k) {
    const GaussianComponent& given = GetParam().components[static_cast<size_t>(k)];
    const GaussianComponent back = mixture.component(k);
    EXPECT_NEAR(back.weight, given.weight / total, 1e-6f);
    EXPECT_EQ(back.mean, given.mean);
    EXPECT_NEAR(back.covariance.xx, given.covariance.xx, 1e-6f);
    EXPECT_NEAR(back.covariance.xy, given.covariance.xy, 1e-6f);
    EXPECT_NEAR(back.covariance.yy, given.covariance.yy, 1e-6f);
  }
}

TEST_P(GaussianMixtureTest, ComponentDensitiesAddUpToTheDensity) {
  if (mixture.is_uniform()) return;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{0.5f, 0.4f}, Vec2{0.99f, 0.01f}}) {
    GaussianMixture::Lanes densities;
    EXPECT_EQ(mixture.eval_components(p, densities), mixture.pdf(p));
    float total = 0;
    for (const float d : densities) total += d;
    EXPECT_NEAR(total, mixture.pdf(p), 1e-5f * mixture.pdf(p));
    EXPECT_GT(mixture.pdf(p), 0);
  }
}

TEST(GaussianMixtureEdgeTest, ZeroWeightsAreDropped) {
  const std::vector<GaussianComponent> components{{0, {0.1f, 0.1f}, {0.01f, 0, 0.01f}},
                                                  {2, {0.5f, 0.5f}, {0.01f, 0, 0.01f}},
                                                  {0, {0.9f, 0.1f}, {0.01f, 0, 0.01f}}};
  const GaussianMixture mixture(components);
  EXPECT_EQ(mixture.size(), 1);
  EXPECT_EQ(mixture.component(0).weight, 1);
  EXPECT_EQ(mixture.effective_components(), 1);
}

TEST(GaussianMixtureEdgeTest, EffectiveComponentsOfEqualWeightsIsTheirNumber) {
  std::vector<GaussianComponent> components(5, {3, {0.5f, 0.5f}, {0.01f, 0, 0.01f}});
  EXPECT_NEAR(GaussianMixture(components).effective_components(), 5, 1e-5);
  EXPECT_EQ(GaussianMixture().effective_components(), 0);
}

// The extreme uniform numbers neither divide by zero nor leave the square as NaN.
TEST_P(GaussianMixtureTest, ExtremeUniformNumbersAreHarmless) {
  for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, one_minus_epsilon})
    for (const float y : {0.0f, 0.5f, one_minus_epsilon})
      if (const auto s = mixture.sample({x, y})) {
        EXPECT_TRUE(s->p.x >= 0 && s->p.x < 1 && s->p.y >= 0 && s->p.y < 1);
        EXPECT_TRUE(std::isfinite(s->pdf) && s->pdf > 0);
      }
}

}  // namespace
}  // namespace tyndall
