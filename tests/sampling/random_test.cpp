// SPDX-License-Identifier: Apache-2.0
#include "tyndall/sampling/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "support/statistical_tests.h"

namespace tyndall {
namespace {

TEST(Random, HashDependsOnEveryArgumentAndTheirOrder) {
  EXPECT_NE(hash(1, 2), hash(2, 1));
  EXPECT_NE(hash(1, 2), hash(1, 2, 0));
  EXPECT_NE(hash(0), hash(0, 0));
  std::set<uint64_t> seen;
  for (int x = -20; x < 20; ++x)
    for (int y = -20; y < 20; ++y) seen.insert(hash(7, x, y));
  EXPECT_EQ(seen.size(), 1600u);
}

TEST(Random, FlippingAnyInputBitFlipsHalfOfTheHash) {
  for (int bit = 0; bit < 64; ++bit) {
    RunningMoments flips;
    for (uint64_t x = 0; x < 500; ++x)
      flips.add(__builtin_popcountll(hash(x) ^ hash(x ^ (uint64_t{1} << bit))));
    EXPECT_NEAR(flips.mean(), 32, 1) << bit;
  }
}

TEST(Random, UniformFloatCoversTheHalfOpenInterval) {
  EXPECT_EQ(uniform_float(0), 0);
  EXPECT_LT(uniform_float(0xffffffffu), 1);
  EXPECT_EQ(uniform_float(0x80000000u), 0.5f);
}

TEST(Random, StreamIsUniformAndUncorrelated) {
  RandomStream random(11);
  std::vector<double> values;
  RunningMoments products;
  double last = 0.5;
  for (int i = 0; i < 100'000; ++i) {
    values.push_back(double{random.next_1d()});
    products.add((values.back() - 0.5) * (last - 0.5));
    last = values.back();
  }
  EXPECT_GT(uniformity_p_value(values), 0.003);
  EXPECT_GT(z_p_value(products, 0), 0.003);
}

TEST(Random, StreamsOfNeighboringKeysAreUnrelated) {
  RunningMoments products;
  for (uint64_t key = 0; key < 2000; ++key) {
    RandomStream a(key), b(key + 1);
    for (int i = 0; i < 10; ++i)
      products.add((double{a.next_1d()} - 0.5) * (double{b.next_1d()} - 0.5));
  }
  EXPECT_GT(z_p_value(products, 0), 0.003);
}

}  // namespace
}  // namespace tyndall
