// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/scene_mark.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

SceneMark room() {
  return {.lights = 3, .bounds = {{-1, -1, 0}, {1, 1, 2}}, .camera = {0, -0.9f, 1}};
}

TEST(SceneMarkTest, RoundingIsNoDifference) {
  SceneMark other = room();
  EXPECT_EQ(difference(room(), other), "");
  other.bounds.max.x *= 1 + 1e-6f;
  other.camera.y *= 1 - 1e-6f;
  EXPECT_EQ(difference(room(), other), "");
  EXPECT_EQ(difference({}, {}), "");  // infinite bounds
}

TEST(SceneMarkTest, SaysWhatDiffers) {
  SceneMark other = room();
  other.lights = 1;
  EXPECT_EQ(difference(room(), other), "which has 1 light, not 3");
  other = room();
  other.bounds.min.z = -1;
  EXPECT_EQ(
      difference(room(), other),
      "which reaches from (-1, -1, -1) to (1, 1, 2), not from (-1, -1, 0) to (1, 1, 2)");
  other = room();
  other.camera.x = 0.001f;
  EXPECT_EQ(difference(room(), other),
            "whose camera stands at (0.001, -0.9, 1), not (0, -0.9, 1)");
  other = room();
  other.world_origin.y = 2;
  EXPECT_EQ(difference(room(), other),
            "whose coordinates begin at (0, 2, 0), not (0, 0, 0)");
  EXPECT_EQ(difference(room(), {.lights = 3}).substr(0, 13), "which reaches");
}

}  // namespace
}  // namespace tyndall
