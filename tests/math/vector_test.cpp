// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tyndall/math/rgb.h"
#include "tyndall/math/vec.h"

namespace tyndall {
namespace {

TEST(Vec3, CrossIsRightHandedAndOrthogonal) {
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(cross({0, 1, 0}, {0, 0, 1}), (Vec3{1, 0, 0}));
  const Vec3 a{1, 2, 3}, b{-4, 0.5f, 2};
  EXPECT_NEAR(dot(cross(a, b), a), 0, 1e-5f);
  EXPECT_NEAR(dot(cross(a, b), b), 0, 1e-5f);
  EXPECT_EQ(cross(a, b), -cross(b, a));
}

TEST(Vec3, ArithmeticIsComponentwise) {
  const Vec3 a{1, 2, 3}, b{4, 5, 6};
  EXPECT_EQ(a + b, (Vec3{5, 7, 9}));
  EXPECT_EQ(b - a, (Vec3{3, 3, 3}));
  EXPECT_EQ(a * b, (Vec3{4, 10, 18}));
  EXPECT_EQ(2 * a, (Vec3{2, 4, 6}));
  EXPECT_EQ(a / 2, (Vec3{0.5f, 1, 1.5f}));
  EXPECT_EQ(dot(a, b), 32);
  EXPECT_EQ(lerp(a, b, 0.5f), (Vec3{2.5f, 3.5f, 4.5f}));
  EXPECT_EQ(a[0] + 10 * a[1] + 100 * a[2], 321);
  EXPECT_EQ(max_component(Vec3{-5, 2, 1}), 2);
  EXPECT_EQ(min_component(Vec3{-5, 2, 1}), -5);
}

TEST(Vec3, LengthsAgree) {
  const Vec3 a{2, 3, 6};
  EXPECT_EQ(length(a), 7);
  EXPECT_EQ(distance(a, a * 2), 7);
  EXPECT_FLOAT_EQ(length(normalize({1e-3f, 5, -9e4f})), 1);
}

TEST(Vec3, FinitenessSeesEachComponent) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 v{1, 1, 1};
    EXPECT_TRUE(is_finite(v));
    v[axis] = infinity;
    EXPECT_FALSE(is_finite(v));
    v[axis] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(is_finite(v));
  }
}

TEST(SphericalDirection, MeasuresFromZAndX) {
  EXPECT_EQ(spherical_direction(1, 2), (Vec3{0, 0, 1}));
  EXPECT_FLOAT_EQ(spherical_direction(0, 0).x, 1);
  EXPECT_FLOAT_EQ(spherical_direction(0, pi / 2).y, 1);
  EXPECT_TRUE(is_finite(spherical_direction(1 + 1e-7f, 1)));
}

TEST(Scalar, SafeOperationsHaveLimits) {
  EXPECT_EQ(safe_sqrt(-1e-9f), 0);
  EXPECT_EQ(safe_sqrt(9), 3);
  EXPECT_EQ(safe_divide(3, 0), 0);
  EXPECT_EQ(safe_divide(3, 2), 1.5f);
  EXPECT_FLOAT_EQ(degrees(radians(75)), 75);
  EXPECT_LT(one_minus_epsilon, 1);
  EXPECT_EQ(std::nextafter(one_minus_epsilon, 2.0f), 1);
}

TEST(Rgb, DividesSafelyPerChannel) {
  EXPECT_EQ(safe_divide(Rgb(1, 2, 3), Rgb(2, 0, 1)), Rgb(0.5f, 0, 3));
}

TEST(Rgb, ReducesToNumbers) {
  EXPECT_FLOAT_EQ(average(Rgb(1, 2, 6)), 3);
  EXPECT_EQ(max_component(Rgb(1, 2, 6)), 6);
  EXPECT_EQ(min_component(Rgb(1, 2, 6)), 1);
  EXPECT_FLOAT_EQ(luminance(Rgb(1)), 1);
  EXPECT_GT(luminance(Rgb(0, 1, 0)), luminance(Rgb(1, 0, 0)));
  EXPECT_TRUE(is_black(Rgb()) && !is_black(Rgb(0, 0, 1e-30f)));
  EXPECT_TRUE(is_grey(Rgb(2)) && !is_grey(Rgb(2, 2, 1)));
  EXPECT_EQ(clamp_negative(Rgb(-1, 0, 2)), Rgb(0, 0, 2));
  EXPECT_FALSE(is_finite(Rgb(1, infinity, 1)));
  EXPECT_FLOAT_EQ(exp(Rgb(0, 1, -1)).g, std::exp(1.0f));
}

}  // namespace
}  // namespace tyndall
