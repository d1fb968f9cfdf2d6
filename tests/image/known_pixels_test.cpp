// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/known_pixels.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace tyndall {
namespace {

std::vector<size_t> around(Vec2i size, const std::set<size_t>& known) {
  return known_pixels(size, [&](size_t pixel) { return known.contains(pixel); });
}

TEST(KnownPixelsTest, KnownOnesStandForThemselves) {
  std::vector<size_t> all(15);
  std::iota(all.begin(), all.end(), size_t{0});
  EXPECT_EQ(known_pixels({5, 3}, [](size_t) { return true; }), all);
  EXPECT_EQ(known_pixels({5, 3}, [](size_t) { return false; }), all);
}

// 0  1  2  3
// 4  5  6  7
// 8  9 10 11: of the whole picture, the square of 4, the first known pixel is 0.
TEST(KnownPixelsTest, TheSmallestSquareIsAsked) {
  const std::vector<size_t> expected{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 10, 10};
  EXPECT_EQ(around({4, 3}, {0, 10}), expected);
  const std::vector<size_t> with_7{0, 0, 7, 7, 0, 0, 7, 7, 0, 0, 10, 10};
  EXPECT_EQ(around({4, 3}, {0, 7, 10}), with_7);
}

TEST(KnownPixelsTest, OneIsEnough) {
  for (const Vec2i size : {Vec2i{1, 9}, Vec2i{7, 3}, Vec2i{16, 16}}) {
    const size_t count = static_cast<size_t>(size.x) * static_cast<size_t>(size.y);
    EXPECT_EQ(around(size, {count - 1}), std::vector<size_t>(count, count - 1));
  }
}

}  // namespace
}  // namespace tyndall
