// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/walk_worth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace tyndall {
namespace {

const Bounds3 box{{-1, -1, -1}, {1, 1, 1}};
constexpr Vec3 up{0, 0, 1}, aside{1, 0, 0};
constexpr int many = 100000;

TEST(WalkWorth, KnowsNothingAtFirst) {
  WalkWorth worth(box);
  EXPECT_TRUE(worth.is_empty());
  worth.update(1);
  EXPECT_TRUE(worth.is_empty());
}

TEST(WalkWorth, TellsPlacesApart) {
  const WalkWorth worth(box);
  std::set<size_t> places;
  for (const float x : {-0.9f, -0.3f, 0.3f, 0.9f})
    for (const Vec3 w : {up, -up, aside, -aside, Vec3{0, 1, 0}, Vec3{0, -1, 0}})
      places.insert(worth.place({x, 0, 0}, w));
  EXPECT_EQ(places.size(), 24u);
  EXPECT_EQ(worth.place({5, 0.1f, 0.1f}, up), worth.place({0.99f, 0.1f, 0.1f}, up));
  EXPECT_LT(*places.rbegin(), worth.places());
}

// Walks whose worth and cost are known: twice the second moment, over what they cost and
// the price.
TEST(WalkWorth, SurvivalFollowsFromWorthAndCost) {
  WalkWorth worth(box);
  const size_t rich = worth.place({0.5f, 0, 0}, up), poor = worth.place({-0.5f, 0, 0}, up);
  for (int i = 0; i < many; ++i) {
    worth.record(rich, i % 2 == 0 ? 2.0f : 0.0f, 4);
    worth.record(poor, 0.1f, 1);
  }
  worth.update(0.5);
  EXPECT_NEAR(worth.survival(rich), std::sqrt(2 * 2 / (4 * 0.5f)), 0.01f);
  EXPECT_NEAR(worth.survival(poor), std::sqrt(2 * 0.01f / 0.5f), 0.01f);
}

TEST(WalkWorth, WhereNoWalkWasItIsAsElsewhere) {
  WalkWorth worth(box);
  for (int i = 0; i < many; ++i) worth.record(worth.place({0, 0, 0}, up), 3, 2);
  worth.update(1);
  const float expected = std::sqrt(2 * 9 / 2.0f);
  EXPECT_NEAR(worth.survival(worth.place({0.9f, 0.9f, 0.9f}, aside)), expected, 1e-3f);
  EXPECT_NEAR(worth.survival(worth.place({0, 0, 0}, aside)), expected, 1e-3f);
}

TEST(WalkWorth, HoldsOutAgainstFireflies) {
  WalkWorth worth(box);
  const size_t place = worth.place({0, 0, 0}, up);
  for (int i = 0; i < many; ++i) worth.record(place, 1, 1);
  worth.record(place, std::numeric_limits<float>::infinity(), 1);
  worth.record(place, std::numeric_limits<float>::quiet_NaN(), 1);
  worth.record(place, 1, std::numeric_limits<float>::quiet_NaN());
  worth.record(place, 1e20f, 1);
  worth.update(1);
  EXPECT_NEAR(worth.survival(place), std::sqrt(2 * 1.1f), 0.01f);
}

TEST(WalkWorth, ForgetsAndLearnsAgain) {
  WalkWorth worth(box);
  const size_t place = worth.place({0, 0, 0}, up);
  worth.record(place, 5, 1);
  worth.update(1);
  worth.clear();
  EXPECT_TRUE(worth.is_empty());
  for (int i = 0; i < many; ++i) worth.record(place, 1, 1);
  worth.update(1);
  EXPECT_NEAR(worth.survival(place), std::sqrt(2.0f), 1e-3f);
}

// The rule is the optimum: other survivals of the same walks give a larger product of
// variance and cost.
TEST(WalkWorth, MinimisesVarianceTimesCost) {
  // A path costs 1, finds 1 -+ 0.5, and goes on to find s with E[s^2] = m at a cost of c.
  const double m = 0.3, c = 2;
  const auto product = [&](double p) { return (0.25 + m / p) * (1 + c * p); };
  double best = 0.01;
  for (double p = 0.01; p < 1; p += 0.001)
    if (product(p) < product(best)) best = p;
  WalkWorth worth(box);
  for (int i = 0; i < many; ++i)
    worth.record(worth.place({0, 0, 0}, up), static_cast<float>(std::sqrt(m / 2)),
                 static_cast<float>(c));  // half of m: the caution doubles it
  worth.update((0.25 + m / best) / (1 + c * best));
  EXPECT_NEAR(double{worth.survival(worth.place({0, 0, 0}, up))}, best, 0.005);
}

TEST(WalkWorth, FlatAndTinyBoxesHaveCells) {
  for (const Bounds3 b : {Bounds3{{0, 0, 0}, {1, 1, 0}}, Bounds3{{2, 2, 2}, {2, 2, 2}},
                          Bounds3{{0, 0, 0}, {1e-20f, 1e-20f, 1e-20f}},
                          Bounds3{{-1e15f, -1e15f, -1e15f}, {1e15f, 1e15f, 1e15f}}}) {
    const WalkWorth worth(b);
    EXPECT_GE(worth.places(), 6u);
    EXPECT_LE(worth.memory(), size_t{16} << 20);
    EXPECT_LT(worth.place(b.max, up), worth.places());
    EXPECT_LT(worth.place({0, 1e30f, -1e30f}, -aside), worth.places());
  }
}

}  // namespace
}  // namespace tyndall
