// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tyndall {
namespace {

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-5f) {
  EXPECT_LE(distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z << " instead of "
                                       << b.x << " " << b.y << " " << b.z;
}

const Transform mixture = Transform::translate({3, -2, 1}) *
                          Transform::rotate(40, {1, 2, 3}) *
                          Transform::scale({2, -0.5f, 3});

TEST(Transform, IdentityDoesNothing) {
  EXPECT_EQ(Transform().point({1, 2, 3}), (Vec3{1, 2, 3}));
  EXPECT_EQ(Transform().vector({1, 2, 3}), (Vec3{1, 2, 3}));
  EXPECT_EQ(Transform() * mixture, mixture);
}

TEST(Transform, TranslationMovesPointsOnly) {
  const Transform t = Transform::translate({1, 2, 3});
  EXPECT_EQ(t.point({1, 1, 1}), (Vec3{2, 3, 4}));
  EXPECT_EQ(t.vector({1, 1, 1}), (Vec3{1, 1, 1}));
  EXPECT_EQ(t.normal({1, 1, 1}), (Vec3{1, 1, 1}));
}

TEST(Transform, RotatesCounterclockwiseAboutTheAxis) {
  expect_near(Transform::rotate(90, {0, 0, 2}).vector({1, 0, 0}), {0, 1, 0});
  expect_near(Transform::rotate(90, {1, 0, 0}).vector({0, 1, 0}), {0, 0, 1});
  expect_near(Transform::rotate(90, {0, 3, 0}).vector({0, 0, 1}), {1, 0, 0});
  expect_near(Transform::rotate(120, {1, 1, 1}).vector({1, 0, 0}), {0, 1, 0});
}

TEST(Transform, ChainsReadRightToLeft) {
  const Transform move = Transform::translate({1, 0, 0}),
                  turn = Transform::rotate(90, {0, 0, 1});
  expect_near((move * turn).point({1, 0, 0}), {1, 1, 0});
  expect_near((turn * move).point({1, 0, 0}), {0, 2, 0});
}

TEST(Transform, InverseUndoes) {
  const Vec3 p{0.3f, -5, 2};
  expect_near(mixture.inverse().point(mixture.point(p)), p);
  expect_near(mixture.inverse().vector(mixture.vector(p)), p);
  expect_near((mixture * mixture.inverse()).point(p), p);
}

TEST(Transform, NormalsStayNormalToSurfaces) {
  const Vec3 a{1, 2, -1}, b{0.5f, -1, 4};
  const Vec3 n = mixture.normal(cross(a, b));
  EXPECT_NEAR(dot(n, mixture.vector(a)), 0, 1e-4f);
  EXPECT_NEAR(dot(n, mixture.vector(b)), 0, 1e-4f);
}

TEST(Transform, KnowsMirrors) {
  EXPECT_FALSE(Transform::rotate(77, {1, 0, 1}).swaps_handedness());
  EXPECT_FALSE(Transform::scale({-1, -1, 1}).swaps_handedness());
  EXPECT_TRUE(Transform::scale({1, -1, 1}).swaps_handedness());
  EXPECT_TRUE(mixture.swaps_handedness());
}

TEST(Transform, LookAtPutsTheTargetAhead) {
  const auto camera_from_world = Transform::look_at({1, 2, 3}, {1, 2, 8}, {0, 1, 0});
  ASSERT_TRUE(camera_from_world);
  expect_near(camera_from_world->point({1, 2, 3}), {});
  expect_near(camera_from_world->point({1, 2, 8}), {0, 0, 5});
  expect_near(camera_from_world->vector({0, 1, 0}), {0, 1, 0});
  expect_near(camera_from_world->vector({1, 0, 0}), {1, 0, 0});  // left-handed: +x is right
  const auto sideways = Transform::look_at({}, {4, 1, 0}, {0, 1, 0});
  expect_near(sideways->point({4, 1, 0}), {0, 0, std::sqrt(17.0f)});
}

TEST(Transform, LookAtNeedsAFrame) {
  EXPECT_FALSE(Transform::look_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0}));
  EXPECT_FALSE(Transform::look_at({}, {0, 3, 0}, {0, 1, 0}));
  EXPECT_FALSE(Transform::look_at({}, {0, 0, 1}, {}));
}

TEST(Transform, RefusesMatricesWithoutInverse) {
  Matrix4 m = mixture.matrix();
  ASSERT_TRUE(Transform::from_matrix(m));
  expect_near(Transform::from_matrix(m)->inverse().point(mixture.point({1, 2, 3})),
              {1, 2, 3});
  m[1] = m[0];
  EXPECT_FALSE(Transform::from_matrix(m));
  EXPECT_FALSE(Transform::from_matrix(Matrix4{}));
  m = Transform().matrix();
  m[2][1] = std::nanf("");
  EXPECT_FALSE(Transform::from_matrix(m));
  m[2][1] = infinity;
  EXPECT_FALSE(Transform::from_matrix(m));
}

TEST(Transform, AcceptsVerySmallAndFarThings) {
  const Transform t =
      Transform::translate({1e6f, 0, 0}) * Transform::scale({1e-6f, 1e-3f, 1e5f});
  const auto again = Transform::from_matrix(t.matrix());
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->inverse().vector({1e-6f, 0, 0}).x, 1, 1e-5f);
  EXPECT_NEAR(again->inverse().vector({0, 0, 1e5f}).z, 1, 1e-5f);
}

TEST(Transform, DividesPointsByW) {
  Matrix4 m = Transform().matrix();
  m[3] = {0, 0, 1, 0};  // w = z
  const auto perspective = Transform::from_matrix(
      Matrix4{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}}});
  ASSERT_TRUE(perspective);
  expect_near(perspective->point({2, 4, 2}), {1, 2, 0.5f});
  EXPECT_FALSE(Transform::from_matrix(m));  // z and w are the same row
}

TEST(Transform, BoundsHoldTheTransformedBox) {
  const Bounds3 box{{-1, 0, 2}, {1, 4, 3}};
  const Bounds3 b = mixture.bounds(box);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(b.contains(mixture.point(box.corner(i))));
  EXPECT_TRUE(mixture.bounds(Bounds3()).is_empty());
}

}  // namespace
}  // namespace tyndall
