// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/bias_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/statistical_tests.h"
#include "tyndall/image/film.h"

namespace tyndall {
namespace {

/// Exponentially distributed samples around `mean`; grey, or each channel on its own.
Image noisy(int size, double mean, unsigned seed, bool grey = true, int samples = 32) {
  std::mt19937 random(seed);
  std::exponential_distribution<float> draw(static_cast<float>(1 / mean));
  Film film({size, size}, {0, 0}, {size, size});
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int i = 0; i < samples; ++i) {
        PathSample sample;
        sample.L = grey ? Rgb(draw(random)) : Rgb{draw(random), draw(random), draw(random)};
        film.add({x, y}, sample, 1);
      }
    }
  }
  return film.develop();
}

TEST(BiasTest, HoldsItsLevelWhenMeansAreEqual) {
  std::vector<double> p_values;
  int images_with_rejections = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const auto test = test_bias(noisy(32, 1, 2 * seed + 1), noisy(32, 1, 2 * seed + 2));
    p_values.push_back(test->p_value);
    images_with_rejections += test->rejected_tiles > 0;
  }
  EXPECT_GT(uniformity_p_value(p_values), 0.01);
  EXPECT_LE(images_with_rejections, 11);  // of 100 at 5 %: more has probability 0.4 %
}

TEST(BiasTest, IndependentChannelsMakeItMilder) {
  const auto test = test_bias(noisy(32, 1, 1, false), noisy(32, 1, 2, false));
  const double expected = std::sqrt(2.0 / 32 / (32 * 32));  // as if the channels were one
  EXPECT_NEAR(test->standard_error, expected, 0.03 * expected);
  EXPECT_GT(test->p_value, 0.05);
}

TEST(BiasTest, SeesTwoPercentOverTheWholeImage) {
  const auto test = test_bias(noisy(64, 1.02, 1), noisy(64, 1, 2));
  EXPECT_NEAR(test->mean_difference, 0.02, 4 * test->standard_error);
  EXPECT_LT(test->p_value, 0.001);
}

TEST(BiasTest, SeesOneWrongTile) {
  Image image = noisy(64, 1, 3);
  const Image reference = noisy(64, 1, 4);
  const auto before = test_bias(image, reference);
  EXPECT_EQ(before->tiles, 16);
  EXPECT_EQ(before->rejected_tiles, 0);
  for (int y = 16; y < 32; ++y) {
    for (int x = 32; x < 48; ++x) image.set_rgb(x, y, image.rgb(x, y) * 1.15f);
  }
  const auto after = test_bias(image, reference);
  EXPECT_EQ(after->rejected_tiles, 1);
  EXPECT_LT(after->smallest_tile_p_value, 1e-6);
}

TEST(BiasTest, CutsTilesAtTheBorderAndLeavesOutWhatIsNotFinite) {
  Image image = noisy(20, 1, 1);
  const Image reference = noisy(20, 1, 2);
  EXPECT_EQ(test_bias(image, reference)->tiles, 4);
  for (int y = 16; y < 20; ++y) {
    for (int x = 16; x < 20; ++x) {
      image.set_rgb(x, y, Rgb(std::numeric_limits<float>::quiet_NaN()));
    }
  }
  const auto test = test_bias(image, reference);
  EXPECT_EQ(test->tiles, 3);
  EXPECT_TRUE(std::isfinite(test->mean_difference));
}

TEST(BiasTest, TakesAReferenceWithoutVarianceAsExact) {
  const Image image = noisy(32, 1, 1);
  Image reference(32, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) reference.set_rgb(x, y, Rgb(1));
  }
  const auto test = test_bias(image, reference);
  EXPECT_FALSE(test->reference_has_variance);
  EXPECT_GT(test->p_value, 0.01);
  EXPECT_FALSE(test_bias(reference, image).has_value());
}

TEST(BiasTest, WithoutSpreadOnlyEqualityPasses) {
  Image black(4, 4);
  black.set_rgb(0, 0, Rgb(0));
  black.set_rgb(0, 0, Rgb(0), "variance");
  EXPECT_EQ(test_bias(black, black)->p_value, 1);
  Image other = black;
  other.set_rgb(1, 1, Rgb(1e-3f));
  EXPECT_EQ(test_bias(other, black)->p_value, 0);
}

}  // namespace
}  // namespace tyndall
