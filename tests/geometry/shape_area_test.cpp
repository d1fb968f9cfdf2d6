// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/chi_square.h"
#include "support/statistical_tests.h"
#include "tests/geometry/test_shapes.h"
#include "tyndall/geometry/shape.h"

namespace tyndall {
namespace {

constexpr int tests = 12;
const double level = sidak(0.01, tests);

/// Compares the texture coordinates of samples, which are the shape's parameters, with the
/// density `area_per_uv` / area.
void expect_uniform(const Shape& shape, const std::function<double(Vec2)>& area_per_uv) {
  const auto total = static_cast<double>(area(shape));
  const ChiSquareResult r = chi_square_square(
      [&](Vec2 u) -> std::optional<Vec2> { return sample_area(shape, u).point.uv; },
      [&](Vec2 uv) { return area_per_uv(uv) / total; }, 100'000, 1, 16);
  EXPECT_GT(r.p_value, level) << r;
  EXPECT_NEAR(r.mass, 1, 1e-4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
  EXPECT_EQ(r.missing, 0);
  EXPECT_NEAR(static_cast<double>(sample_area(shape, {0.3f, 0.4f}).pdf_area), 1 / total,
              1e-5 / total);
}

TEST(SampleArea, IsUniformOnPatches) {
  const std::vector<std::vector<Vec3>> patches{
      {{0, 0, 0}, {2, 0, 0}, {0.5f, 1, 0}, {2.5f, 1, 0}},
      {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0.5f, 1, 0}},
      {{-1, -1, -2}, {1, -1, 2}, {-1, 1, 2}, {1, 1, -2}}};
  for (const std::vector<Vec3>& corners : patches) {
    const BilinearMesh mesh(corners, {{0, 1, 2, 3}}, {}, {}, false);
    expect_uniform(mesh, [&](Vec2 uv) {
      return length(
          mesh.patch(0).normal(static_cast<double>(uv.x), static_cast<double>(uv.y)));
    });
  }
}

TEST(SampleArea, IsUniformOnSpheresAndDisks) {
  const Transform t = Transform::rotate(40, {1, 2, 3}) * Transform::scale({2, 2, 2});
  const Sphere sphere{t, 1.5f, -1, 0.6f, 4, false};
  const float low = std::acos(-1 / 1.5f), high = std::acos(0.6f / 1.5f);
  expect_uniform(sphere, [&](Vec2 uv) {
    const auto theta = static_cast<double>(low + (high - low) * uv.y);
    return 9 * std::sin(theta) * 4 * static_cast<double>(low - high);
  });
  const Disk disk{t, 1, 1.5f, 0.5f, 4, false};
  expect_uniform(disk, [&](Vec2 uv) { return 4.0 * 4 * static_cast<double>(1.5f - uv.y); });
}

TEST(SampleArea, IsUniformOnTriangles) {
  // Texture coordinates that are the barycentric ones; the areas are 1/2, 0 and 3/2.
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, -3, 0}},
                          {{0, 1, 2}, {0, 1, 3}, {0, 4, 1}}, {},
                          {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 1}}, false);
  RandomStream random(1);
  RunningMoments b1, b2, b1_squared, b1_b2, in_small;
  for (int i = 0; i < 100'000; ++i) {
    const ShapeSample sample = sample_area(mesh, random.next_2d());
    EXPECT_NEAR(sample.pdf_area, 0.5f, 1e-6f);
    const bool is_small = sample.point.p.y > 0;
    in_small.add(is_small);
    if (!is_small) continue;
    const auto x = static_cast<double>(sample.point.uv.x),
               y = static_cast<double>(sample.point.uv.y);
    b1.add(x);
    b2.add(y);
    b1_squared.add(x * x);
    b1_b2.add(x * y);
  }
  EXPECT_GT(z_p_value(in_small, 0.25), level);
  EXPECT_GT(z_p_value(b1, 1.0 / 3), level);
  EXPECT_GT(z_p_value(b2, 1.0 / 3), level);
  EXPECT_GT(z_p_value(b1_squared, 1.0 / 6), level);
  EXPECT_GT(z_p_value(b1_b2, 1.0 / 12), level);
}

// The mean of 1 / pdf is the area, and of f / pdf the integral of f.
TEST(SampleArea, IntegratesOverAnEllipsoid) {
  const Sphere s{Transform::scale({1, 1, 0.5f}), 1, -1, 1, 2 * pi, false};
  RandomStream random(2);
  RunningMoments area_estimate, north;
  for (int i = 0; i < 100'000; ++i) {
    const ShapeSample sample = sample_area(s, random.next_2d());
    const double weight = 1 / static_cast<double>(sample.pdf_area);
    area_estimate.add(weight);
    north.add(sample.point.p.z > 0.25f ? weight : 0);
  }
  EXPECT_GT(z_p_value(area_estimate, static_cast<double>(area(s))), level);
  // Of the cap above a quarter of the axis, by revolution: the area between heights a and c
  // of the spheroid with half axis c is pi c / e times the integral of sqrt(1 + y^2) from
  // e a / c^2 to e / c, e the eccentricity; doubled.
  const double c = 0.5, e = std::sqrt(1 - c * c);
  const auto primitive = [](double y) {
    return 0.5 * (y * std::sqrt(1 + y * y) + std::asinh(y));
  };
  const double k = e / (c * c);
  const double cap = 2 * 3.14159265358979 / k * (primitive(k * c) - primitive(k * 0.25));
  EXPECT_GT(z_p_value(north, cap), level) << north.mean() << ' ' << cap;
}

}  // namespace
}  // namespace tyndall
