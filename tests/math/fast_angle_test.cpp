// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/fast_angle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tyndall {
namespace {

TEST(FastAngle, IsTheArcTangentAllAroundTheUpperHalf) {
  float previous = -1;
  for (int i = 0; i <= 10'000; ++i) {
    const double angle = 3.14159265358979 * i / 10'000;
    for (const double size : {1e-15, 1.0, 1e15}) {
      const auto x = static_cast<float>(size * std::cos(angle));
      const auto y = static_cast<float>(std::max(size * std::sin(angle), 0.0));
      EXPECT_NEAR(fast_angle(x, y), std::atan2(double{y}, double{x}), 2e-4) << angle;
    }
    const auto on_circle = fast_angle(static_cast<float>(std::cos(angle)),
                                      static_cast<float>(std::sin(angle)));
    EXPECT_GT(on_circle, previous - 1e-6f);
    previous = on_circle;
  }
}

TEST(FastAngle, OfNothingIsZero) {
  EXPECT_EQ(fast_angle(0, 0), 0);
  EXPECT_EQ(fast_angle(1, 0), 0);
  EXPECT_EQ(fast_angle(-1, 0), pi);
}

}  // namespace
}  // namespace tyndall
