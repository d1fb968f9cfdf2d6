// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/statistics.h"

#include <gtest/gtest.h>

#include <vector>

namespace tyndall {
namespace {

TEST(RunningMoments, MatchTheDefinition) {
  RunningMoments m;
  for (const double x : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) m.add(x);
  EXPECT_EQ(m.count(), 8);
  EXPECT_DOUBLE_EQ(m.mean(), 5);
  EXPECT_DOUBLE_EQ(m.variance(), 32.0 / 7);
  EXPECT_DOUBLE_EQ(m.standard_error(), std::sqrt(32.0 / 56));
}

TEST(RunningMoments, SaysNothingOfOneSample) {
  RunningMoments m;
  EXPECT_EQ(m.variance(), 0);
  m.add(3);
  EXPECT_EQ(m.mean(), 3);
  EXPECT_EQ(m.variance(), 0);
  EXPECT_EQ(m.standard_error(), 0);
}

TEST(RunningMoments, SurviveALargeOffset) {
  RunningMoments m;
  for (const double x : {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}) m.add(x);
  EXPECT_DOUBLE_EQ(m.variance(), 30);
}

TEST(RunningMoments, MergeAsIfAddedOneByOne) {
  RunningMoments all, left, right, empty;
  for (int i = 0; i < 100; ++i) {
    const double x = i * i % 17 - 3.5;
    all.add(x);
    (i < 30 ? left : right).add(x);
  }
  left.merge(right);
  left.merge(empty);
  empty.merge(left);
  for (const RunningMoments& m : {left, empty}) {
    EXPECT_EQ(m.count(), 100);
    EXPECT_NEAR(m.mean(), all.mean(), 1e-12);
    EXPECT_NEAR(m.variance(), all.variance(), 1e-10);
  }
}

}  // namespace
}  // namespace tyndall
