// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/statistical_tests.h"
#include "tests/geometry/test_shapes.h"
#include "tyndall/geometry/shape.h"
#include "tyndall/math/statistics.h"

namespace tyndall {
namespace {

constexpr double pi_d = std::numbers::pi;

Sphere sphere_at(Vec3 center, float radius) {
  return {Transform::translate(center) * Transform::rotate(50, {3, 1, 2}),
          radius,
          -radius,
          radius,
          2 * pi,
          false};
}

/// 1 - cos of the half angle of the cone, by a series that needs no difference.
double one_minus_cos(double radius, double distance) {
  const double half = 0.5 * std::asin(radius / distance);
  return 2 * std::sin(half) * std::sin(half);
}

TEST(SphereCone, HasTheDensityOfTheClosedForm) {
  for (const float radius : {1e-6f, 1e-3f, 1.0f, 1e3f})
    for (const float ratio : {1.01f, 1.5f, 10.0f, 1e4f, 1e8f, 1e12f}) {
      const float distance = radius * ratio;
      const Sphere s = sphere_at({0, 0, distance}, radius);
      const auto sample = s.sample_direction({0, 0, 0}, {0.3f, 0.6f});
      ASSERT_TRUE(sample);
      const double expected =
          1 / (2 * pi_d *
               one_minus_cos(static_cast<double>(radius), static_cast<double>(distance)));
      EXPECT_NEAR(static_cast<double>(sample->pdf), expected, 1e-5 * expected);
      EXPECT_EQ(s.direction_pdf({0, 0, 0}, sample->point), sample->pdf);
    }
}

TEST(SphereCone, IsEmptyOrFiniteAtTheLimits) {
  RandomStream random(1);
  const auto expect_finite = [&](const Sphere& s, Vec3 from) {
    for (int i = 0; i < 1000; ++i) {
      const auto sample = s.sample_direction(from, random.next_2d());
      if (!sample) continue;
      EXPECT_TRUE(std::isfinite(sample->pdf) && sample->pdf > 0) << sample->pdf;
      EXPECT_TRUE(is_finite(sample->point.p));
      EXPECT_NEAR(length(sample->point.ng), 1, 1e-6f);
      EXPECT_TRUE(std::isfinite(s.direction_pdf(from, sample->point)));
    }
  };
  expect_finite(sphere_at({0, 0, 0}, 1), {1, 0, 0});
  expect_finite(sphere_at({0, 0, 0}, 1), {1.000001f, 0, 0});
  expect_finite(sphere_at({0, 0, 0}, 1), {0.999999f, 0, 0});
  expect_finite(sphere_at({0, 0, 0}, 1), {0, 0, 0});
  expect_finite(sphere_at({0, 0, 1e18f}, 1e-3f), {0, 0, 0});
  expect_finite(sphere_at({0, 0, 0}, 1e9f), {0, 0, 1.1e9f});
  EXPECT_FALSE(sphere_at({0, 0, 1}, 0).sample_direction({0, 0, 0}, {0.5f, 0.5f}));
  EXPECT_FALSE(sphere_at({0, 0, 1e10f}, 1e-12f).sample_direction({0, 0, 0}, {0.5f, 0.5f}));
}

TEST(SphereCone, PointsLieOnTheSideThatIsSeen) {
  RandomStream random(2);
  for (const float distance : {1.001f, 1.1f, 3.0f, 1e3f}) {
    const Vec3 center = random_direction(random) * distance;
    const Sphere s = sphere_at(center, 1);
    for (int i = 0; i < 1000; ++i) {
      const auto sample = s.sample_direction({0, 0, 0}, random.next_2d());
      ASSERT_TRUE(sample);
      EXPECT_NEAR(tyndall::distance(sample->point.p, center), 1, 1e-6f * (1 + distance));
      EXPECT_LT(dot(sample->point.ng, sample->point.p), 1e-3f * distance);
    }
    // What cannot be seen is never sampled.
    SurfacePoint back{.p = center * (1 + 1 / distance),
                      .ng = center * (1 / distance),
                      .ns = {},
                      .uv = {}};
    EXPECT_EQ(s.direction_pdf({0, 0, 0}, back), 0);
  }
}

// Over the cone the mean direction is (1 + cos) / 2 times its axis, and the mean of the
// squared component along the axis (1 + cos + cos^2) / 3.
TEST(SphereCone, DirectionsHaveTheMomentsOfACone) {
  const double level = sidak(0.01, 4 * 4);
  for (const float distance : {1.01f, 1.2f, 2.0f, 20.0f}) {
    RandomStream random(3);
    const Vec3 axis = random_direction(random);
    const Sphere s = sphere_at(axis * distance, 1);
    const Vec3 across = normalize(cross(axis, {0, 0, 1}));
    RunningMoments along, squared, sideways, upward;
    for (int i = 0; i < 100'000; ++i) {
      const auto sample = s.sample_direction({0, 0, 0}, random.next_2d());
      const Vec3 wi = normalize(sample->point.p);
      const auto z = static_cast<double>(dot(wi, axis));
      along.add(z);
      squared.add(z * z);
      sideways.add(static_cast<double>(dot(wi, across)));
      upward.add(static_cast<double>(dot(wi, cross(axis, across))));
    }
    const double cos = 1 - one_minus_cos(1, static_cast<double>(distance));
    EXPECT_GT(z_p_value(along, (1 + cos) / 2), level) << distance;
    EXPECT_GT(z_p_value(squared, (1 + cos + cos * cos) / 3), level) << distance;
    EXPECT_GT(z_p_value(sideways, 0), level) << distance;
    EXPECT_GT(z_p_value(upward, 0), level) << distance;
  }
}

// From inside, all directions are alike, however near the wall is.
TEST(SphereInside, DirectionsAreUniform) {
  const double level = sidak(0.01, 3 * 4);
  for (const float off_center : {0.0f, 0.5f, 0.99f}) {
    RandomStream random(4);
    const Vec3 from = random_direction(random) * (2 * off_center);
    Sphere s = sphere_at({0, 0, 0}, 2);
    s.flip_normals = true;
    RunningMoments squared, mean[3];
    for (int i = 0; i < 100'000; ++i) {
      const auto sample = s.sample_direction(from, random.next_2d());
      ASSERT_TRUE(sample);
      ASSERT_FLOAT_EQ(sample->pdf, 1 / (4 * pi));
      ASSERT_EQ(s.direction_pdf(from, sample->point), sample->pdf);
      ASSERT_NEAR(length(sample->point.p), 2, 1e-5f);
      ASSERT_NEAR(dot(sample->point.ng, sample->point.p), -2, 1e-5f);
      const Vec3 w = normalize(sample->point.p - from);
      for (int axis = 0; axis < 3; ++axis) mean[axis].add(static_cast<double>(w[axis]));
      squared.add(static_cast<double>(w.x * w.x));
    }
    for (const RunningMoments& m : mean) EXPECT_GT(z_p_value(m, 0), level) << off_center;
    EXPECT_GT(z_p_value(squared, 1 / 3.0), level) << off_center;
  }
}

}  // namespace
}  // namespace tyndall
