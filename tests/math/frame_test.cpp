// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/frame.h"

#include <gtest/gtest.h>

#include <vector>

namespace tyndall {
namespace {

std::vector<Vec3> directions() {
  std::vector<Vec3> all{{0, 0, 1},
                        {0, 0, -1},
                        {1, 0, 0},
                        {0, -1, 0},
                        {0, 1, -0.0f},
                        normalize({1e-4f, -1e-4f, -1}),
                        normalize({1, 1, -1e-7f})};
  for (int i = 0; i < 200; ++i) {
    const auto k = static_cast<float>(i);
    all.push_back(spherical_direction(1 - 2 * (k + 0.5f) / 200, 2.4f * k));
  }
  return all;
}

TEST(Frame, IsRightHandedAndOrthonormal) {
  for (const Vec3 z : directions()) {
    const Frame f = Frame::from_z(z);
    EXPECT_EQ(f.z, z);
    EXPECT_NEAR(length(f.x), 1, 1e-6f);
    EXPECT_NEAR(length(f.y), 1, 1e-6f);
    EXPECT_NEAR(dot(f.x, f.y), 0, 1e-6f);
    EXPECT_NEAR(dot(f.x, f.z), 0, 1e-6f);
    EXPECT_NEAR(dot(f.y, f.z), 0, 1e-6f);
    EXPECT_LT(distance(cross(f.x, f.y), f.z), 2e-6f);
  }
}

TEST(Frame, LocalAndWorldAreInverse) {
  const Vec3 v{0.3f, -2, 5};
  for (const Vec3 z : directions()) {
    const Frame f = Frame::from_z(z);
    EXPECT_LT(distance(f.to_local(f.to_world(v)), v), 1e-5f);
    EXPECT_LT(distance(f.to_world({0, 0, 1}), z), 1e-6f);
    EXPECT_NEAR(f.to_local(z).z, 1, 1e-6f);
  }
}

}  // namespace
}  // namespace tyndall
