// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "image/temporary_folder.h"
#include "tyndall/image/flip.h"
#include "tyndall/image/tone.h"

namespace tyndall {
namespace {

Image constant(int width, int height, Rgb value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, value);
  }
  return image;
}

/// The image and reference of expected_metrics.py.
std::pair<Image, Image> formula_images() {
  Image image(48, 40), reference(48, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      Rgb a, b;
      for (int c = 0; c < 3; ++c) {
        const double r = (0.55 + 0.45 * std::sin(0.4 * x + 0.25 * y + 1.3 * c)) *
                         std::exp2((x - 24) / 12.0);
        const double noise = std::sin(12.9898 * x + 78.233 * y + 37.719 * c);
        b[c] = static_cast<float>(r);
        a[c] = static_cast<float>(r * (1 + 0.25 * noise));
      }
      image.set_rgb(x, y, a);
      reference.set_rgb(x, y, b);
    }
  }
  return {image, reference};
}

TEST(MetricsTest, MatchHandComputedValues) {
  Image image = constant(2, 1, Rgb(1));
  image.set_rgb(1, 0, {1, 3, 1});
  const ImageErrors e = measure_errors(image, constant(2, 1, Rgb(1)), {.epsilon = 0.25});
  EXPECT_DOUBLE_EQ(e.mse, 4.0 / 6);
  EXPECT_DOUBLE_EQ(e.rel_mse, 4 / 1.25 / 6);
  EXPECT_DOUBLE_EQ(e.rel_mse_trimmed, 0);  // a thousandth of two pixels is one pixel
  EXPECT_DOUBLE_EQ(e.smape, 2 * 2.0 / 4 / 6);
  EXPECT_DOUBLE_EQ(e.percentile_99_9, 2.0 / 3);
  EXPECT_DOUBLE_EQ(e.mean, 8.0 / 6);
  EXPECT_DOUBLE_EQ(e.reference_mean, 1);
}

// sRGB values 0.5 and 0.6 apart from black and white: known squares.
TEST(MetricsTest, PsnrIsOfDisplayImages) {
  const Image a = constant(4, 4, Rgb(linear_from_srgb(0.6f)));
  const Image b = constant(4, 4, Rgb(linear_from_srgb(0.5f)));
  EXPECT_NEAR(measure_errors(a, b).psnr, 20, 1e-4);
  EXPECT_NEAR(measure_errors(constant(1, 1, Rgb(7)), constant(1, 1, Rgb(0))).psnr, 0, 1e-6);
  EXPECT_TRUE(std::isinf(measure_errors(a, a).psnr));
}

// The numbers are printed by expected_metrics.py: NumPy and the authors'
// flip-evaluator 1.7.
TEST(MetricsTest, MatchIndependentImplementations) {
  const auto [image, reference] = formula_images();
  const ImageErrors e = measure_errors(image, reference);
  EXPECT_NEAR(e.mse, 0.0349937198127432, 1e-12);
  EXPECT_NEAR(e.rel_mse, 0.026187022491727312, 1e-12);
  EXPECT_NEAR(e.rel_mse_trimmed, 0.026149398570214075, 1e-12);
  EXPECT_NEAR(e.smape, 0.16081556130855457, 1e-12);
  EXPECT_NEAR(e.psnr, 27.241002198613366, 1e-4);
  EXPECT_NEAR(e.percentile_99_9, 0.6923068761825562, 1e-12);
  EXPECT_NEAR(e.mean, 0.7316565018134296, 1e-12);
  EXPECT_NEAR(e.reference_mean, 0.7308388263973433, 1e-12);
  EXPECT_NEAR(*e.ldr_flip, 0.05336981639266014, 1e-5);
  EXPECT_NEAR(*e.hdr_flip, 0.0470166951417923, 1e-5);
}

TEST(FlipTest, PixelsMatchTheAuthorsImplementation) {
  const auto [image, reference] = formula_images();
  const std::vector<float> ldr = ldr_flip(image, reference);
  EXPECT_NEAR(ldr[20 * 48 + 30], 0.02826127f, 1e-5f);
  EXPECT_NEAR(ldr[0], 0.08350549f, 1e-5f);
  EXPECT_NEAR(ldr[39 * 48 + 47], 0.24070594f, 1e-5f);
  const std::vector<float> hdr = hdr_flip(image, reference);
  EXPECT_NEAR(hdr[20 * 48 + 30], 0.023442654f, 1e-5f);
  EXPECT_NEAR(hdr[0], 0.08591999f, 1e-5f);
  EXPECT_NEAR(hdr[39 * 48 + 47], 0.2444105f, 1e-5f);
  const ExposureRange range = hdr_flip_exposures(reference);
  EXPECT_NEAR(range.start, -0.6993187069892883, 1e-5);
  EXPECT_NEAR(range.stop, 2.1992053985595703, 1e-5);
  EXPECT_EQ(range.count, 3);
}

TEST(FlipTest, AgreesOverSixteenStops) {
  auto [image, reference] = formula_images();
  reference.set_rgb(10, 20, Rgb(3e4f));
  image.set_rgb(10, 20, Rgb(2e4f));
  const ExposureRange range = hdr_flip_exposures(reference);
  EXPECT_NEAR(range.start, -13.78937816619873, 1e-5);
  EXPECT_NEAR(range.stop, 2.1923270225524902, 1e-5);
  EXPECT_EQ(range.count, 16);
  EXPECT_NEAR(*measure_errors(image, reference).hdr_flip, 0.05008240044116974, 1e-5);
  EXPECT_NEAR(hdr_flip(image, reference)[20 * 48 + 12], 0.068269484f, 1e-5f);
}

TEST(FlipTest, SeveralImagesAtOnceAreTheSame) {
  const auto [image, reference] = formula_images();
  const auto maps = hdr_flip({&image, &reference}, reference);
  EXPECT_EQ(maps.at(0), hdr_flip(image, reference));
  EXPECT_EQ(maps.at(1), std::vector<float>(image.pixel_count()));
}

TEST(FlipTest, PixelsThatAreNotFiniteCountAsEqual) {
  auto [image, reference] = formula_images();
  Image broken = image, mended = image;
  broken.set_rgb(10, 20, Rgb(std::numeric_limits<float>::quiet_NaN()));
  mended.set_rgb(10, 20, reference.rgb(10, 20));
  EXPECT_EQ(hdr_flip(broken, reference), hdr_flip(mended, reference));
  EXPECT_EQ(ldr_flip(broken, reference), ldr_flip(mended, reference));
}

TEST(FlipTest, EndsOfTheScale) {
  const Image green = constant(40, 40, {0, 1, 0}), blue = constant(40, 40, {0, 0, 1});
  for (float value : ldr_flip(green, green)) EXPECT_EQ(value, 0);
  for (float value : ldr_flip(green, blue)) EXPECT_NEAR(value, 1, 1e-4);
}

TEST(FlipTest, ExposureActsBeforeClipping) {
  const Image a = constant(8, 8, Rgb(0.25f)), b = constant(8, 8, Rgb(0.3f));
  EXPECT_GT(ldr_flip(a, b)[0], 0.02f);
  EXPECT_EQ(ldr_flip(a, b, 2)[0], 0);
}

TEST(FlipTest, BlackReferenceHasAnExposure) {
  const Image black = constant(8, 8, Rgb(0));
  EXPECT_EQ(hdr_flip(black, black)[0], 0);
  EXPECT_TRUE(std::isfinite(hdr_flip(constant(8, 8, Rgb(1)), black)[0]));
}

TEST(MetricsTest, CountsPixelsThatAreNotFiniteAndLeavesThemOut) {
  const ImageErrors clean =
      measure_errors(constant(48, 40, Rgb(1)), constant(48, 40, Rgb(2)));
  Image a = constant(48, 40, Rgb(1)), b = constant(48, 40, Rgb(2));
  a.set_rgb(3, 3, {1, std::numeric_limits<float>::quiet_NaN(), 1});
  a.set_rgb(4, 3, {1, std::numeric_limits<float>::infinity(), 1});
  b.set_rgb(5, 5, Rgb(-std::numeric_limits<float>::infinity()));
  const ImageErrors e = measure_errors(a, b);
  EXPECT_EQ(e.not_finite, 2);
  EXPECT_EQ(e.reference_not_finite, 1);
  EXPECT_DOUBLE_EQ(e.mse, clean.mse);
  EXPECT_DOUBLE_EQ(e.rel_mse, clean.rel_mse);
  EXPECT_TRUE(std::isfinite(*e.hdr_flip));
  const std::vector<float> map = relative_square_errors(a, b, 0.01);
  EXPECT_TRUE(std::isnan(map[3 * 48 + 3]));
  EXPECT_FLOAT_EQ(map[0], 1 / 4.01f);
}

TEST(MetricsTest, RefusesWhatCannotBeCompared) {
  const auto message = [](const Image& a, const Image& b) {
    return message_of([&] { measure_errors(a, b); });
  };
  const Image color = constant(2, 3, Rgb(1));
  EXPECT_EQ(message(color, constant(3, 2, Rgb(1))),
            "the image has 2 x 3 pixels, the reference 3 x 2");
  EXPECT_EQ(message(Image(2, 3), color), "the image has no R, G and B channels");
  EXPECT_EQ(message(color, Image(2, 3)), "the reference has no R, G and B channels");
  EXPECT_EQ(message(constant(2, 3, Rgb(std::numeric_limits<float>::quiet_NaN())), color),
            "no pixel is finite in both images");
}

}  // namespace
}  // namespace tyndall
