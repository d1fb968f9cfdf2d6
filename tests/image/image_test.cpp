// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/image.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

TEST(ImageTest, AddsChannelsOfZerosOnce) {
  Image image(3, 2);
  image.channel("depth.Z").values[4] = 7;
  EXPECT_EQ(image.channel("depth.Z").values, (std::vector<float>{0, 0, 0, 0, 7, 0}));
  EXPECT_EQ(image.channels().size(), 1u);
  EXPECT_EQ(image.find("depth"), nullptr);
}

TEST(ImageTest, KeepsLayersApart) {
  Image image(2, 2);
  image.set_rgb(1, 0, {1, 2, 3});
  image.set_rgb(1, 0, {4, 5, 6}, "variance");
  EXPECT_EQ(image.rgb(1, 0), Rgb(1, 2, 3));
  EXPECT_EQ(image.rgb(1, 0, "variance"), Rgb(4, 5, 6));
  EXPECT_EQ(image.rgb_planes("variance")[1], Rgb(4, 5, 6));
  EXPECT_FALSE(image.has_rgb("albedo"));
}

}  // namespace
}  // namespace tyndall
