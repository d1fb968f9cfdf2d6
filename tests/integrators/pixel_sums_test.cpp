// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/pixel_sums.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

TEST(PixelSums, KeepsThePixelsOfSmallPicturesApart) {
  PixelSums sums({5, 3});
  ASSERT_EQ(sums.size(), 15u);
  sums.record({4, 2}, 7);
  sums.record({4, 2}, -2);
  sums.record({0, 1}, 1);
  EXPECT_EQ(sums[14].value, 5);
  EXPECT_EQ(sums[14].count, 2);
  EXPECT_EQ(sums[5].count, 1);
  sums.clear();
  EXPECT_EQ(sums[14].value, 0);
  EXPECT_EQ(sums[14].count, 0);
}

TEST(PixelSums, EachBlockHoldsItsPixel) {
  for (const Vec2i resolution : {Vec2i{1, 1}, Vec2i{257, 2}, Vec2i{1920, 1080}}) {
    PixelSums sums(resolution);
    for (size_t i = 0; i < sums.size(); ++i) {
      const Vec2i p = sums.pixel(i);
      ASSERT_LT(p.x, resolution.x);
      ASSERT_LT(p.y, resolution.y);
      sums.record(p, 1);
      ASSERT_EQ(sums[i].count, 1) << i;
    }
  }
}

TEST(PixelSums, PixelsBeyondThePictureCountToTheNearest) {
  PixelSums sums({4, 4});
  sums.record({-1, 100}, 1);
  sums.record({1 << 30, 1 << 30}, 1);
  EXPECT_EQ(sums[12].count, 1);
  EXPECT_EQ(sums[15].count, 1);
}

}  // namespace
}  // namespace tyndall
