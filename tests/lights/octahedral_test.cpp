// SPDX-License-Identifier: Apache-2.0
#include "tyndall/lights/octahedral.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/chi_square.h"
#include "support/jacobian.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

void expect_near(Vec3 a, Vec3 b) {
  EXPECT_LT(distance(a, b), 1e-6f) << a.x << " " << a.y << " " << a.z;
}

// The landmarks of pbrt-v4's images: +z in the middle, -z in the corners, +x to the right
// and +y in the rows with large numbers.
TEST(Octahedral, HasTheOrientationOfPbrt) {
  expect_near(octahedral_direction({0.5f, 0.5f}), {0, 0, 1});
  expect_near(octahedral_direction({0, 0}), {0, 0, -1});
  expect_near(octahedral_direction({1, 0}), {0, 0, -1});
  expect_near(octahedral_direction({1, 0.5f}), {1, 0, 0});
  expect_near(octahedral_direction({0, 0.5f}), {-1, 0, 0});
  expect_near(octahedral_direction({0.5f, 1}), {0, 1, 0});
  expect_near(octahedral_direction({0.5f, 0}), {0, -1, 0});
  const float h = std::sqrt(0.5f);
  expect_near(octahedral_direction({0.75f, 0.75f}), {h, h, 0});
  // Half way to +x the cap has a quarter of the area of the hemisphere, z = 3/4.
  expect_near(octahedral_direction({0.75f, 0.5f}), {std::sqrt(7.0f) / 4, 0, 0.75f});
  // Outside the diamond: the mirror image of half way to +x lies near the corner.
  expect_near(octahedral_direction({1, 0.75f}), {std::sqrt(7.0f) / 4, 0, -0.75f});
}

TEST(Octahedral, KeepsAreas) {
  const ChiSquareResult r =
      chi_square_sphere(octahedral_direction, [](Vec3) { return double{inv_4pi}; });
  EXPECT_GT(r.p_value, 0.005) << r;
  for (const Vec2 p :
       {Vec2{0.6f, 0.7f}, Vec2{0.1f, 0.2f}, Vec2{0.9f, 0.7f}, Vec2{0.3f, 0.45f}})
    EXPECT_NEAR(surface_jacobian(octahedral_direction, p) * double{inv_4pi}, 1, 2e-3);
}

TEST(Octahedral, PositionUndoesDirection) {
  RandomStream random(1);
  for (int i = 0; i < 20'000; ++i) {
    const Vec2 p = random.next_2d();
    const Vec3 w = octahedral_direction(p);
    ASSERT_NEAR(length(w), 1, 1e-6f);
    const Vec2 back = octahedral_position(w);
    ASSERT_NEAR(back.x, p.x, 2e-6f);
    ASSERT_NEAR(back.y, p.y, 2e-6f);
  }
}

TEST(Octahedral, DirectionUndoesPositionAlsoOnAxesAndPlanes) {
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 w = normalize(
            {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
        const Vec2 p = octahedral_position(w);
        ASSERT_TRUE(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1);
        expect_near(octahedral_direction(p), w);
      }
}

}  // namespace
}  // namespace tyndall
