// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "apps/tyndall/report/html_text.h"
#include "apps/tyndall/report/insets.h"
#include "apps/tyndall/report/picture_code.h"

namespace tyndall::app {
namespace {

Image grey(int width, int height, float value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, Rgb(value));
  }
  return image;
}

TEST(HtmlTextTest, EscapesWhatHtmlMeans) {
  EXPECT_EQ(escape_html("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
}

TEST(HtmlTextTest, Base64MatchesTheStandardsExamples) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(LevelScaleTest, KeepsRadianceToHalfALevel) {
  const LevelScale scale{1e-3, 32};
  for (float x = 1e-6f; x < 1e9f; x *= 1.7f) {
    const double back = scale.radiance(scale.level(x));
    EXPECT_NEAR(back, x, (double{x} + 1e-3) * (std::exp2(0.5 / 32) - 1) * 1.001) << x;
  }
  EXPECT_EQ(scale.level(0), 0);
  EXPECT_EQ(scale.level(-1), 0);
  EXPECT_EQ(scale.level(std::numeric_limits<float>::infinity()), infinite_level);
  EXPECT_EQ(scale.level(std::numeric_limits<float>::quiet_NaN()), not_a_number_level);
}

TEST(LevelScaleTest, FollowsTheMedian) {
  EXPECT_NEAR(choose_scale(grey(4, 4, 2.56f), 8).floor, 0.01, 1e-8);
  EXPECT_EQ(choose_scale(grey(4, 4, 0), 8).floor, 1.0 / 256);
}

// By hand: predictions 0, 10, 10, (20 + 10) / 2; differences 10, 10, 0, -25.
TEST(PictureCodeTest, PacksDifferencesFromTheNeighbours) {
  const std::string packed = pack_plane({10, 20, 10, 65526}, 2);
  EXPECT_EQ(packed, std::string("\x14\x14\x00\x31\x00\x00\x00\x00", 8));
}

TEST(InsetsTest, FindsWhereImagesDiffer) {
  const Image reference = grey(200, 160, 1);
  Image image = reference;
  for (int y = 100; y < 120; ++y) {
    for (int x = 50; x < 70; ++x) image.set_rgb(x, y, Rgb(1.8f));
  }
  image.set_rgb(150, 20, Rgb(1e6f));  // a firefly does not outweigh a region
  const std::vector<Inset> insets = choose_insets({&image}, reference, 3);
  ASSERT_EQ(insets.size(), 3u);
  const Inset first = insets[0];
  EXPECT_LE(first.x, 50);
  EXPECT_GE(first.x + first.size, 70);
  EXPECT_LE(first.y, 100);
  EXPECT_GE(first.y + first.size, 120);
  for (size_t i = 1; i < insets.size(); ++i) {
    EXPECT_TRUE(std::abs(insets[i].x - first.x) >= first.size ||
                std::abs(insets[i].y - first.y) >= first.size);
  }
  EXPECT_EQ(cut_out(image, {50, 100, 24}).rgb(0, 0), Rgb(1.8f));
}

TEST(InsetsTest, TakesSmallPictures) {
  const Image reference = grey(10, 7, 1);
  const std::vector<Inset> insets = choose_insets({&reference}, reference, 3);
  ASSERT_EQ(insets.size(), 1u);
  EXPECT_EQ(insets[0].size, 7);
}

}  // namespace
}  // namespace tyndall::app
