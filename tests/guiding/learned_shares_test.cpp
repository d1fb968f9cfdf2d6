// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/learned_shares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/math/statistics.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// Two techniques on [0, 1]: uniform, and the density 2 x. The integrand decides who is
// needed.
struct Experiment {
  double (*f)(double x);
  ShareTarget target;

  double second_moment(const Shares<2>& shares) const {
    double sum = 0;
    for (int i = 0; i < 100'000; ++i) {
      const double x = (i + 0.5) / 100'000;
      sum += f(x) * f(x) /
             (static_cast<double>(shares[0]) + static_cast<double>(shares[1]) * 2 * x);
    }
    return sum / 100'000;
  }

  ShareStatistics<2> sample(const Shares<2>& shares, int n, uint64_t seed) const {
    ShareStatistics<2> statistics;
    RandomStream random(seed);
    for (int i = 0; i < n; ++i) {
      const bool first = random.next_1d() < shares[0];
      const float u = random.next_1d();
      const float x = first ? u : std::sqrt(u);
      const std::array<float, 2> densities{1, 2 * x};
      const double p = static_cast<double>(shares[0] + shares[1] * 2 * x);
      statistics.add(f(static_cast<double>(x)) / p, p, densities, shares, target);
    }
    return statistics;
  }

  Shares<2> learn(int passes, const ShareSettings& settings) const {
    Shares<2> shares{0.5f, 0.5f};
    for (int pass = 0; pass < passes; ++pass)
      shares =
          sample(shares, 20'000, static_cast<uint64_t>(pass)).improve(shares, settings);
    return shares;
  }
};

TEST(LearnedSharesTest, FindTheTechniqueThatFits) {
  for (const ShareTarget target : {ShareTarget::divergence, ShareTarget::second_moment}) {
    ShareSettings settings;
    settings.target = target;
    const Experiment rising{[](double x) { return x; }, target};
    const Experiment flat{[](double) { return 1.0; }, target};
    EXPECT_NEAR(rising.learn(100, settings)[1], 0.9f, 0.02f);
    EXPECT_NEAR(flat.learn(100, settings)[0], 0.9f, 0.02f);
  }
}

// 0.3 + 1.4 x is the mixture with shares 0.3 and 0.7 exactly.
TEST(LearnedSharesTest, FindTheMixtureThatFits) {
  for (const ShareTarget target : {ShareTarget::divergence, ShareTarget::second_moment}) {
    ShareSettings settings;
    settings.target = target;
    const Experiment both{[](double x) { return 0.3 + 1.4 * x; }, target};
    EXPECT_NEAR(both.learn(200, settings)[0], 0.3f, 0.03f);
  }
}

TEST(LearnedSharesTest, TheSecondMomentFalls) {
  ShareSettings settings;
  settings.floor = 0.01f;
  settings.prior_count = 0;
  const Experiment edge{[](double x) { return x > 0.8 ? 1.0 : 0.1; }, settings.target};
  Shares<2> shares{0.5f, 0.5f};
  double last = edge.second_moment(shares);
  for (uint64_t pass = 0; pass < 5; ++pass) {
    shares = edge.sample(shares, 200'000, pass).improve(shares, settings);
    EXPECT_LT(edge.second_moment(shares), last);
    last = edge.second_moment(shares);
  }
}

// Samples drawn by other shares than those in use lead to the same place.
TEST(LearnedSharesTest, DoNotDependOnHowTheSamplesWereDrawn) {
  const auto f = [](double x) { return 0.3 + 1.4 * x; };
  ShareSettings settings;
  for (const ShareTarget target : {ShareTarget::divergence, ShareTarget::second_moment}) {
    Shares<2> shares{0.5f, 0.5f};
    RandomStream random(1);
    for (int pass = 0; pass < 100; ++pass) {
      ShareStatistics<2> statistics;
      for (int i = 0; i < 10'000; ++i) {
        const float x = random.next_1d();
        statistics.add(f(static_cast<double>(x)), 1, {1, 2 * x}, shares, target);
      }
      shares = statistics.improve(shares, settings);
    }
    EXPECT_NEAR(shares[0], 0.3f, 0.03f);
  }
}

TEST(LearnedSharesTest, StatisticsAddUp) {
  const Experiment rising{[](double x) { return x; }, ShareTarget::divergence};
  const Shares<2> shares{0.4f, 0.6f};
  ShareStatistics<2> sum = rising.sample(shares, 100, 1);
  const ShareStatistics<2> part = rising.sample(shares, 50, 2);
  const double before = sum.sums[1];
  sum += part;
  EXPECT_DOUBLE_EQ(sum.sums[1], before + part.sums[1]);
  EXPECT_NEAR(sum.sums[0] + sum.sums[1], sum.importance, 1e-9);
}

TEST(LearnedSharesTest, FewSamplesChangeLittleAndBadOnesNothing) {
  ShareSettings settings;
  ShareStatistics<2> statistics;
  const Shares<2> shares{0.5f, 0.5f};
  EXPECT_EQ(statistics.improve(shares, settings), shares);
  for (const double w : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e300})
    statistics.add(w, 1, {1, 1}, shares, settings.target);
  statistics.add(1, 1, {0, 0}, shares, settings.target);
  EXPECT_EQ(statistics.importance, 0);
  statistics.add(1, 1, {0, 1}, shares, settings.target);
  EXPECT_NEAR(statistics.improve(shares, settings)[1], 0.505f, 1e-3f);
}

TEST(LearnedSharesTest, NoShareFallsBelowTheFloor) {
  const Shares<3> shares = ShareStatistics<3>::with_floor({1, 0, 0}, 0.1f);
  EXPECT_FLOAT_EQ(shares[0], 0.8f);
  EXPECT_FLOAT_EQ(shares[1], 0.1f);
  const Shares<3> kept = ShareStatistics<3>::with_floor({0.5f, 0.3f, 0.2f}, 0.1f);
  EXPECT_FLOAT_EQ(kept[0] + kept[1] + kept[2], 1);
  EXPECT_FLOAT_EQ(kept[2], 0.2f);
}

}  // namespace
}  // namespace tyndall
