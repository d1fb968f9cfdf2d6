// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/bounds.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

constexpr Bounds3 box{{-1, 0, 2}, {1, 4, 3}};

TEST(Bounds, AreEmptyUntilExtended) {
  Bounds3 b;
  EXPECT_TRUE(b.is_empty());
  EXPECT_EQ(b.radius(), 0);
  EXPECT_FALSE(b.contains({}));
  b.extend(Vec3{1, 2, 3});
  EXPECT_FALSE(b.is_empty());
  EXPECT_TRUE(b.contains({1, 2, 3}));
  b.extend(box);
  EXPECT_TRUE(b.contains({-1, 0, 2}) && b.contains({1, 4, 3}));
}

TEST(Bounds, ExtendingByNothingChangesNothing) {
  Bounds3 b = box;
  b.extend(Bounds3());
  EXPECT_EQ(b.min, box.min);
  EXPECT_EQ(b.max, box.max);
}

TEST(Bounds, SphereHoldsAllCorners) {
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(box.contains(box.corner(i)));
    EXPECT_LE(distance(box.corner(i), box.center()), box.radius() * 1.000001f);
    for (int j = 0; j < i; ++j) EXPECT_NE(box.corner(i), box.corner(j));
  }
}

TEST(BoundsIntersect, ClipsTheLine) {
  const auto through = box.intersect({0, 1, 0}, {0, 0, 1}, 100);
  ASSERT_TRUE(through);
  EXPECT_EQ(through->min, 2);
  EXPECT_EQ(through->max, 3);
  EXPECT_EQ(box.intersect({0, 1, 0}, {0, 0, 1}, 2.5f)->max, 2.5f);
  EXPECT_EQ(box.intersect({0, 1, 2.5f}, {0, 0, 1}, 100)->min, 0);
  EXPECT_EQ(box.intersect({0, 1, 5}, {0, 0, -2}, 100)->min, 1);
}

TEST(BoundsIntersect, MissesWhatItMisses) {
  EXPECT_FALSE(box.intersect({0, 1, 0}, {0, 0, -1}, 100));
  EXPECT_FALSE(box.intersect({0, 1, 0}, {0, 0, 1}, 1.5f));
  EXPECT_FALSE(box.intersect({2, 1, 0}, {0, 0, 1}, 100));
  EXPECT_FALSE(box.intersect({-3, -1, 2.5f}, {1, -0.1f, 0}, 100));
  EXPECT_FALSE(Bounds3().intersect({}, {0, 0, 1}, 100));
}

TEST(BoundsIntersect, WorksDiagonallyAndUnboundedly) {
  const Bounds3 unit{{0, 0, 0}, {1, 1, 1}};
  const auto t = unit.intersect({-1, -1, -1}, {1, 1, 1}, infinity);
  ASSERT_TRUE(t);
  EXPECT_FLOAT_EQ(t->min, 1);
  EXPECT_FLOAT_EQ(t->max, 2);
  EXPECT_TRUE(unit.intersect({0, 0.5f, -1}, {0, 0, 1}, infinity));  // along a face
}

}  // namespace
}  // namespace tyndall
