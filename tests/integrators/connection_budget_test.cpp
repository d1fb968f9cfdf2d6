// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/connection_budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

constexpr Vec2i size{64, 64};
constexpr int paths = 1000;

// In each region, `paths` paths of one leg find 1 -+ walk, and two single connections on
// the first leg find 0.5 -+ noise, where noise and brightness may differ between left and
// right.
struct Half {
  float brightness = 1, walk = 1, noise = 1;
};

void record(ConnectionBudget& budget, const Half& left, const Half& right) {
  for (int y = 0; y < size.y; y += 8)
    for (int x = 0; x < size.x; x += 8) {
      const Half& half = x < size.x / 2 ? left : right;
      const size_t region = budget.region({x, y});
      for (int i = 0; i < paths; ++i) {
        const float sign = i % 2 == 0 ? 1.0f : -1.0f;
        const float noise = half.brightness * half.noise;
        budget.record({region, Effort::single, 0}, half.brightness * 0.5f + sign * noise);
        budget.record_pair({region, Effort::single, 0}, noise * noise);
        budget.record_path({x, y},
                           {.value = half.brightness * (1 + sign * half.walk), .legs = 1});
      }
    }
  budget.update();
}

TEST(ConnectionBudget, KnowsNothingAtFirst) {
  ConnectionBudget budget(1, size);
  EXPECT_EQ(budget.count(budget.region({3, 3}), Effort::single, 0), 2);
  budget.update();
  EXPECT_EQ(budget.count(budget.region({3, 3}), Effort::dual, 20), 1);
}

TEST(ConnectionBudget, EveryPixelHasARegion) {
  const ConnectionBudget budget(1, {40, 7});
  EXPECT_EQ(budget.region({0, 0}), 0);
  EXPECT_EQ(budget.region({-1, -1}), 0);
  EXPECT_EQ(budget.region({39, 6}), 8 * 7 - 1);
  EXPECT_EQ(budget.region({1 << 30, 1 << 30}), 8 * 7 - 1);
}

TEST(ConnectionBudget, ConnectsAsOftenAsItPays) {
  // sqrt(M / c * C / V), with the costs of a single connection and of a leg, 2.8 and 3.5.
  const float walk = 0.5f, noise = 1;
  ConnectionBudget budget(1, size);
  record(budget, {1, walk, noise}, {1, walk, noise});
  const float variance = walk * walk * paths / (paths - 1);
  const float expected = std::sqrt(noise * noise / 2.8f * 3.5f / variance);
  EXPECT_NEAR(budget.count(budget.region({9, 9}), Effort::single, 0), expected, 1e-3);
  EXPECT_NEAR(budget.mean_count(Effort::single, 0), double{expected}, 1e-3);
}

TEST(ConnectionBudget, CountsAllThatAConnectionFindsWhereItIsLeftToChance) {
  // Without noise, but with a mean: the mean square is 1/4.
  ConnectionBudget budget(1, size);
  record(budget, {1, 1, 0}, {1, 1, 0});
  EXPECT_NEAR(budget.count(budget.region({9, 9}), Effort::single, 0),
              std::sqrt(0.25f / 2.8f * 3.5f), 1e-3);
}

// Half of the pixels of a region find three times as much as the others: that does not vary
// between the paths of a pixel.
TEST(ConnectionBudget, DetailsOfThePictureAreNotNoise) {
  ConnectionBudget budget(1, size);
  for (int x = 0; x < size.x; ++x)
    for (int i = 0; i < paths; ++i) {
      const float sign = i % 2 == 0 ? 1.0f : -1.0f;
      const float mean = x % 2 == 0 ? 0.5f : 1.5f;
      budget.record_path({x, 0}, {.value = mean + 0.1f * sign, .legs = 2});
    }
  budget.update();
  EXPECT_NEAR(budget.price(), 0.01 / 7, 0.02 * 0.01 / 7);
}

// A lamp in the picture is far brighter than what squares are clamped to, and does not
// vary.
TEST(ConnectionBudget, LampsInThePictureAreNotNoise) {
  for (const float lamp : {1.0f, 500.0f}) {
    ConnectionBudget budget(1, size);
    for (int i = 0; i < paths; ++i) {
      const float sign = i % 2 == 0 ? 1.0f : -1.0f;
      budget.record_path({3, 3}, {.value = lamp, .legs = 2});
      for (int x = 10; x < size.x; x += 2)
        budget.record_path({x, 40}, {.value = 1 + 0.1f * sign, .legs = 2});
    }
    budget.update();
    // The mean of the picture is part of the scale, as in relMSE.
    const double mean = (double{lamp} + 27) / 28;
    const double expected = 27.0 / 28 * 0.01 / (1 + 0.01 * sqr(mean)) / 7;
    EXPECT_NEAR(budget.price(), expected, 0.06 * expected) << lamp;
  }
}

TEST(ConnectionBudget, WeighsRadianceByThatOfTheRegion) {
  ConnectionBudget budget(1, size);
  record(budget, {1, 0.5f, 1}, {4, 0.5f, 1});
  const float dark = budget.relative(budget.region({9, 9}), 1);
  const float bright = budget.relative(budget.region({50, 9}), 1);
  EXPECT_NEAR(dark, 1, 0.1f);
  EXPECT_NEAR(bright, 0.25f, 0.02f);
}

TEST(ConnectionBudget, DarkRegionsCountAsMuchAsBrightOnes) {
  ConnectionBudget budget(1, size);
  record(budget, {1, 0.5f, 1}, {4, 0.5f, 1});
  const float dark = budget.count(budget.region({9, 9}), Effort::single, 0);
  const float bright = budget.count(budget.region({50, 9}), Effort::single, 0);
  // By squared error the bright half would get four times as many. The epsilon of relMSE
  // and the prior leave 6 %.
  EXPECT_NEAR(dark, bright, 0.08f * bright);
}

TEST(ConnectionBudget, SpendsWhereTheNoiseIs) {
  ConnectionBudget budget(1, size);
  record(budget, {1, 1, 0.2f}, {1, 1, 2});
  const float quiet = budget.count(budget.region({9, 9}), Effort::single, 0);
  const float noisy = budget.count(budget.region({50, 9}), Effort::single, 0);
  EXPECT_LE(quiet, 1);
  EXPECT_GT(noisy, 2);
}

// In each region, half of the places are predicted to find 1, half to find 9.
void record_places(ConnectionBudget& budget) {
  for (size_t region = 0; region < max_regions; ++region)
    for (int i = 0; i < 500; ++i)
      for (const float predicted : {1.0f, 9.0f})
        budget.record_place({region, Effort::single, 0, predicted});
}

TEST(ConnectionBudget, ConnectsMoreOftenWhereMoreIsPredicted) {
  ConnectionBudget budget(1, size);
  record_places(budget);
  record(budget, {1, 0.5f, 1}, {1, 0.5f, 1});
  const size_t region = budget.region({9, 9});
  const float typical = budget.count(region, Effort::single, 0);
  const auto count = [&](float predicted) {
    return budget.count({region, Effort::single, 0, predicted});
  };
  EXPECT_NEAR(count(3), typical, 1e-3f * typical);
  EXPECT_NEAR(count(1), typical * std::sqrt(0.5f + 0.5f / 9), 1e-3f * typical);
  EXPECT_NEAR(count(0), typical * std::sqrt(0.5f), 1e-3f * typical);
  EXPECT_EQ(count(1e30f), most_of_a_kind);
  EXPECT_EQ(count(NAN), typical);
  EXPECT_EQ(budget.count({region, Effort::dual, 0, 9}),
            budget.count(region, Effort::dual, 0));
}

// What varies little is made once; made by chance it would vary by all that it finds.
TEST(ConnectionBudget, LeavesNothingToChanceThatIsWorthIt) {
  ConnectionBudget budget(1, size);
  record_places(budget);
  record(budget, {1, 0.05f, 0}, {1, 0.05f, 0});
  const size_t region = budget.region({9, 9});
  ASSERT_EQ(budget.count(region, Effort::single, 0), 1);
  EXPECT_EQ(budget.count({region, Effort::single, 0, 1}), 1);
  EXPECT_GT(budget.count({region, Effort::single, 0, 9}), 1);
}

// Where the second moments are as predicted, counts are the roots of them over the cost.
TEST(ConnectionBudget, SpendsAsPredictionsSay) {
  ConnectionBudget known(1, size), predicted(1, size);
  const float walk = 1, value = 0.5f;
  record_places(predicted);
  record(predicted, {1, walk, 0}, {1, walk, 0});
  for (int i = 0; i < 100; ++i) {
    record_places(predicted);
    for (size_t region = 0; region < max_regions; ++region) {
      for (int k = 0; k < 200; ++k) known.record({region, Effort::single, 0}, value);
      for (const float p : {1.0f, 9.0f}) {
        const ConnectionPlace place{region, Effort::single, 0, p};
        const float chance = std::min(predicted.count(place), 1.0f);
        const float root = std::sqrt(0.5f + 0.5f * p * p / 9);
        for (int k = 0; k < static_cast<int>(100 * chance); ++k)
          predicted.record(place, value * root);
      }
    }
  }
  record(known, {1, walk, 0}, {1, walk, 0});
  record(predicted, {1, walk, 0}, {1, walk, 0});
  const size_t region = known.region({9, 9});
  const float typical = known.count(region, Effort::single, 0);
  ASSERT_GT(typical, 0.3f);
  for (const float p : {1.0f, 9.0f})
    EXPECT_NEAR(predicted.count({region, Effort::single, 0, p}) / typical,
                std::sqrt(0.5f + 0.5f * p * p / 9), 0.05f)
        << p;
}

TEST(ConnectionBudget, HoldsOutAgainstFireflies) {
  ConnectionBudget budget(1, size);
  record(budget, {1, 0.5f, 0.1f}, {1, 0.5f, 0.1f});
  const float before = budget.count(budget.region({9, 9}), Effort::single, 0);
  budget.record_path({0, 0}, {.value = INFINITY, .legs = 1});
  budget.record({0, Effort::single, 0}, NAN);
  budget.record_pair({0, Effort::single, 0}, INFINITY);
  budget.update();
  EXPECT_NEAR(budget.count(budget.region({9, 9}), Effort::single, 0), before, 0.01f);
}

// Plain paths that find less on average, and seem to vary little, have missed what is rare.
TEST(ConnectionBudget, NoticesWhatPlainPathsMiss) {
  for (const float plain : {1.0f, 0.8f}) {
    ConnectionBudget budget(1, size);
    for (int i = 0; i < 5000; ++i) {
      const float sign = i % 2 == 0 ? 1.0f : -1.0f;
      budget.record_path({0, 0}, {.value = 1 + sign, .legs = 1, .spent = 3});
      budget.record_plain_path(0, {.value = plain + 0.9f * sign, .legs = 1});
    }
    budget.update();
    EXPECT_EQ(budget.pays(), plain < 1);
  }
}

// Everywhere, paths that find 1 -+ deviation: with connections of this cost, and without.
bool pays(float with, float spent, float without, double overhead = 1,
          double least_efficiency = 0.85) {
  ConnectionBudget budget(1, size, overhead, least_efficiency);
  for (int x = 0; x < size.x; ++x)
    for (int i = 0; i < paths; ++i) {
      const size_t region = budget.region({x, 0});
      const float sign = i % 2 == 0 ? 1.0f : -1.0f;
      budget.record_path({x, 0}, {.value = 1 + sign * with, .legs = 2, .spent = spent});
      budget.record_plain_path(region, {.value = 1 + sign * without, .legs = 2});
    }
  budget.update();
  return budget.pays();
}

TEST(ConnectionBudget, GivesUpWhatGainsNothing) {
  EXPECT_FALSE(pays(1, 4, 1));
  EXPECT_TRUE(pays(1, 2, 1.3f));   // 1.7 times the variance, at a cost of 9 to 5
  EXPECT_FALSE(pays(1, 4, 1.3f));  // the same, 11 to 5
  EXPECT_FALSE(pays(1, 2, 1.3f, 2));
  EXPECT_TRUE(pays(1, 0, 1.15f));  // 1.3 times, 7 to 5
  EXPECT_FALSE(pays(1, 1, 1.1f));  // 1.2 times, 8 to 5
}

TEST(ConnectionBudget, GivesUpWhatGainsLessThanIsAskedFor) {
  EXPECT_FALSE(pays(1, 2, 1.3f, 1, 1.1));  // 1.7 times the variance, at a cost of 9 to 5
  EXPECT_TRUE(pays(1, 2, 1.5f, 1, 1.1));   // 2.3 times
  EXPECT_FALSE(pays(1, 0, 1.2f, 1, 1.1));  // 1.44 times, 7 to 5
  EXPECT_TRUE(pays(1, 0, 1.3f, 1, 1.1));   // 1.7 times
}

// One path in a thousand finds a lamp: that they vary more than was seen is likely.
TEST(ConnectionBudget, IsCarefulWithHeavyTails) {
  for (const bool is_rare : {false, true}) {
    ConnectionBudget budget(1, size);
    for (int i = 0; i < 5000; ++i) {
      const float sign = i % 2 == 0 ? 1.0f : -1.0f;
      // Both sorts of plain paths have the variance 1.
      const float plain = is_rare ? (i % 1000 == 0 ? 32.6f : 0.97f) : 1 + sign;
      budget.record_path({0, 0}, {.value = 1 + sign, .legs = 1, .spent = 3});
      budget.record_plain_path(0, {.value = plain, .legs = 1});
    }
    budget.update();
    EXPECT_EQ(budget.pays(), is_rare);
  }
}

TEST(ConnectionBudget, KnowsWhatLitSurfacesGain) {
  // Two techniques with densities p and q find f: alone, the second has squares f^2 / q,
  // together those of both with their shares, of which the first, made n times, has 1 / n.
  const double f = 3, p = 0.8, q = 0.2;
  for (const double n : {0.5, 1.0, 3.0}) {
    const double tried = std::max(n, 1.0) * p;
    const double share = tried / (tried + q), found = share * f / p;
    const double alone = f * f / q;
    const double together = sqr((1 - share) * f) / q + sqr(found) * p / n;
    const float gain = ConnectionBudget::lit_gain(float(found), float(share), float(n));
    EXPECT_NEAR(p * double{gain}, alone - together, 1e-4 * alone);
  }
}

// Whether connections to lit surfaces pay that gain and cost so much of paths of
// variance 1.
bool lit_pays(float gain, float spent) {
  ConnectionBudget budget(1, size);
  for (int i = 0; i < 2 * 4096; ++i) {
    const float value = i % 2 == 0 ? 2.0f : 0.0f;
    budget.record_path(
        {0, 0},
        {.value = value, .legs = 1, .spent = spent, .lit_gain = gain, .lit_spent = spent});
    budget.record_plain_path(0, {.value = value, .legs = 1});
  }
  budget.update();
  return budget.lit_pays();
}

TEST(ConnectionBudget, GivesUpLitSurfacesThatGainNothing) {
  // A leg costs 3.5: with 3.5 more, the variance has to double, and a third of that counts.
  EXPECT_TRUE(lit_pays(0.5f, 3.5f));
  EXPECT_FALSE(lit_pays(0.25f, 3.5f));
  EXPECT_FALSE(lit_pays(-1, 0.5f));
  EXPECT_TRUE(lit_pays(0, 0));  // there are none to give up
}

TEST(ConnectionBudget, DecidesOnce) {
  ConnectionBudget budget(1, size);
  const auto trial = [&](float with) {
    for (int i = 0; i < 5000; ++i) {
      const float sign = i % 2 == 0 ? 1.0f : -1.0f;
      budget.record_path({0, 0}, {.value = 1 + sign * with, .legs = 1, .spent = 3});
      budget.record_plain_path(0, {.value = 1 + sign, .legs = 1});
    }
    budget.update();
    return budget.pays();
  };
  EXPECT_TRUE(trial(0.1f));
  EXPECT_TRUE(trial(2));
}

TEST(ConnectionBudget, DoesNotJudgeByFewPaths) {
  ConnectionBudget budget(1, size);
  for (int i = 0; i < 3999; ++i) {
    budget.record_path({0, 0},
                       {.value = i % 2 == 0 ? 2.0f : 0.0f, .legs = 1, .spent = 100});
    budget.record_plain_path(0, {.value = 1, .legs = 1});
  }
  budget.update();
  EXPECT_TRUE(budget.pays());
}

}  // namespace
}  // namespace tyndall
