// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/false_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tyndall/image/tone.h"

namespace tyndall {
namespace {

TEST(FalseColorTest, GetsLighterAllTheWay) {
  for (int i = 0; i < 100; ++i) {
    const float x = static_cast<float>(i) / 100;
    EXPECT_LT(luminance(false_color(x)), luminance(false_color(x + 0.01f))) << x;
  }
}

TEST(FalseColorTest, EndsAreThePublishedColors) {
  const Rgb first = false_color(-1), last = false_color(2);
  EXPECT_NEAR(srgb_from_linear(first.b), 4 / 255.0f, 1e-6f);
  EXPECT_NEAR(srgb_from_linear(last.r), 252 / 255.0f, 1e-6f);
  EXPECT_NEAR(srgb_from_linear(last.g), 1, 1e-6f);
  EXPECT_NEAR(srgb_from_linear(last.b), 164 / 255.0f, 1e-6f);
}

TEST(FalseColorTest, ImageSpansTheGivenRange) {
  const std::vector<float> values = {2, 3, 4, std::numeric_limits<float>::quiet_NaN()};
  const Image image = false_color_image(values, 2, 2, 2, 4);
  EXPECT_EQ(image.rgb(0, 0), false_color(0));
  EXPECT_EQ(image.rgb(1, 0), false_color(0.5f));
  EXPECT_EQ(image.rgb(0, 1), false_color(1));
  EXPECT_TRUE(std::isnan(image.rgb(1, 1).g));
}

}  // namespace
}  // namespace tyndall
