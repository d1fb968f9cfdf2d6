// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/chi_square.h"
#include "support/statistical_tests.h"
#include "tests/geometry/test_shapes.h"
#include "tyndall/geometry/intersector.h"

namespace tyndall {
namespace {

struct Case {
  std::string name;
  Shape shape;
  Vec3 from;
};

Transform placed(Vec3 at, float scale) {
  return Transform::translate(at) * Transform::rotate(40, {1, 2, 3}) *
         Transform::scale({scale, scale, scale});
}

Sphere full_sphere(const Transform& t, float radius) {
  return {t, radius, -radius, radius, 2 * pi, false};
}

BilinearMesh saddle() {
  return {{{-1, -1, -0.5f}, {1, -1, 0.5f}, {-1, 1, 0.5f}, {1, 1, -0.5f}},
          {{0, 1, 2, 3}}, {}, {}, false};
}

std::vector<Case> cases() {
  const Transform squashed = Transform::translate({0.3f, 0, 0}) * Transform::rotate(30, {1, 1, 0}) *
                             Transform::scale({1, 0.6f, -1.4f});
  return {
      {"triangle", TriangleMesh({{-1, -1, 0}, {1, -1, 0.5f}, {0, 1, 0}}, {{0, 1, 2}}, {}, {}, false),
       {0.2f, 0.1f, 1}},
      {"box from inside", box_mesh({0, 0, 0}, {1, 2, 1.5f}, true), {0.5f, 0.4f, -0.3f}},
      {"sphere from outside", full_sphere(placed({1, 2, 3}, 2), 0.5f), {0, 0, 1}},
      {"sphere from nearby", full_sphere(placed({0, 0, 0}, 1), 1), {0, 0.01f, 1.01f}},
      {"sphere from inside", full_sphere(placed({0, 0, 0}, 1), 1), {0.1f, 0.4f, -0.2f}},
      {"partial sphere", Sphere{placed({0, 0, 0}, 1), 1, -0.3f, 0.8f, 4, false}, {0.1f, 0.2f, 0}},
      {"ellipsoid from inside", full_sphere(squashed, 1), {0.3f, 0.1f, 0.1f}},
      {"disk", Disk{placed({0, 0, 0}, 1), 0.1f, 1, 0, 2 * pi, false}, {0.5f, 0.5f, 1}},
      {"annulus", Disk{squashed, 0.1f, 1, 0.4f, 4, false}, {0.2f, -0.5f, 0.9f}},
      {"rectangle", BilinearMesh({{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}},
                                 {}, {}, false), {0.9f, 0.4f, 0.3f}},
      {"trapezoid", BilinearMesh({{-1, -1, 0}, {1, -1, 0}, {-0.3f, 1, 0}, {0.4f, 1, 0}},
                                 {{0, 1, 2, 3}}, {}, {}, false), {0, 0.4f, 0.7f}},
      {"saddle", saddle(), {0.1f, 0.2f, 1.5f}},
  };
}

Intersector intersector_of(const Shape& shape) {
  const std::vector<Intersector::Group> groups{{{&shape, false}}};
  return Intersector(groups, {});
}

/// Density of a direction: the sum over all points of the shape that lie there.
double total_pdf(const Case& c, const Intersector& intersector, Vec3 wi) {
  double sum = 0;
  Ray ray{c.from, wi};
  while (const auto hit = intersector.intersect(ray, infinity, RayMask::all)) {
    sum += static_cast<double>(direction_pdf(c.shape, c.from, hit->point));
    ray.o = offset_origin(hit->point.p, hit->point.ng, wi);
  }
  return sum;
}

TEST(SampleDirection, AgreesWithItsDensity) {
  const std::vector<Case> all = cases();
  for (const Case& c : all) {
    SCOPED_TRACE(c.name);
    const Intersector intersector = intersector_of(c.shape);
    const ChiSquareResult r = chi_square_sphere(
        [&](Vec2 u) -> std::optional<Vec3> {
          const auto sample = sample_direction(c.shape, c.from, u);
          if (!sample) return std::nullopt;
          return normalize(sample->point.p - c.from);
        },
        [&](Vec3 wi) { return total_pdf(c, intersector, wi); }, 50'000, 1,
        {.rings = 16, .sectors = 32});
    EXPECT_GT(r.p_value, sidak(0.01, static_cast<int>(all.size()))) << r;
    EXPECT_NEAR(r.mass, 1, 1e-3) << r;
    EXPECT_EQ(r.missing, 0);
    EXPECT_LT(r.samples_of_zero_pdf, 5) << r;
  }
}

}  // namespace
}  // namespace tyndall
