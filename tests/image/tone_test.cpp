// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tyndall {
namespace {

Image grey(int width, int height, float value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, Rgb(value));
  }
  return image;
}

TEST(ToneTest, TransferFunctionHasTheStandardsValues) {
  EXPECT_NEAR(srgb_from_linear(0.5f), 0.735357f, 1e-5f);
  EXPECT_NEAR(srgb_from_linear(0.18f), 0.461356f, 1e-5f);
  EXPECT_NEAR(srgb_from_linear(0.001f), 0.01292f, 1e-6f);
  EXPECT_FLOAT_EQ(srgb_from_linear(1), 1);
  for (float x : {0.0f, 0.002f, 0.0031308f, 0.01f, 0.3f, 1.0f}) {
    EXPECT_NEAR(linear_from_srgb(srgb_from_linear(x)), x, 1e-6f);
  }
}

TEST(ToneTest, ExposureCountsStops) {
  EXPECT_EQ(tone_map(Rgb(0.25f), {.exposure = 1}), Rgb(0.5f));
  EXPECT_EQ(tone_map(Rgb(0.25f), {.exposure = -2}), Rgb(0.0625f));
  EXPECT_EQ(tone_map({-1, 2, 0.5f}, {}), Rgb(0, 1, 0.5f));
}

// The published fit at x = 1 is 2.54 / 3.16.
TEST(ToneTest, FilmicCurveIsNarkowiczs) {
  const ToneMapping filmic{.curve = ToneCurve::filmic};
  EXPECT_FLOAT_EQ(tone_map(Rgb(1), filmic).r, 2.54f / 3.16f);
  EXPECT_EQ(tone_map(Rgb(0), filmic).r, 0);
  EXPECT_EQ(tone_map(Rgb(1e30f), filmic).r, 1);
  EXPECT_EQ(tone_map(Rgb(std::numeric_limits<float>::infinity()), filmic).r, 1);
}

TEST(ToneTest, NotANumberIsMagenta) {
  Image image = grey(2, 1, 0);
  image.set_rgb(1, 0, {0, std::numeric_limits<float>::quiet_NaN(), 0});
  EXPECT_EQ(srgb8_from_image(image, {}), (std::vector<uint8_t>{0, 0, 0, 255, 0, 255}));
}

TEST(ToneTest, DitheringKeepsTheMeanBetweenTwoLevels) {
  const float value = linear_from_srgb(100.25f / 255);
  const std::vector<uint8_t> bytes =
      srgb8_from_image(grey(16, 16, value), {.dither = true});
  int higher = 0;
  for (uint8_t b : bytes) {
    EXPECT_TRUE(b == 100 || b == 101);
    higher += b == 101;
  }
  EXPECT_EQ(higher, static_cast<int>(bytes.size()) / 4);
}

TEST(ToneTest, EightBitValuesSurviveDithering) {
  Image image(256, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 256; ++x) {
      image.set_rgb(x, y, Rgb(linear_from_srgb8(static_cast<uint8_t>(x))));
    }
  }
  for (bool dither : {false, true}) {
    const std::vector<uint8_t> bytes = srgb8_from_image(image, {.dither = dither});
    for (size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], (i / 3) % 256);
  }
}

}  // namespace
}  // namespace tyndall
