// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

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
          {{0, 1, 2, 3}},
          {},
          {},
          false};
}

std::vector<Case> cases() {
  const Transform squashed = Transform::translate({0.3f, 0, 0}) *
                             Transform::rotate(30, {1, 1, 0}) *
                             Transform::scale({1, 0.6f, -1.4f});
  return {
      {"triangle",
       TriangleMesh({{-1, -1, 0}, {1, -1, 0.5f}, {0, 1, 0}}, {{0, 1, 2}}, {}, {}, false),
       {0.2f, 0.1f, 1}},
      {"box from inside", box_mesh({0, 0, 0}, {1, 2, 1.5f}, true), {0.5f, 0.4f, -0.3f}},
      {"sphere from outside", full_sphere(placed({1, 2, 3}, 2), 0.5f), {0, 0, 1}},
      {"sphere from nearby", full_sphere(placed({0, 0, 0}, 1), 1), {0, 0.01f, 1.01f}},
      {"sphere from inside", full_sphere(placed({0, 0, 0}, 1), 1), {0.1f, 0.4f, -0.2f}},
      {"partial sphere",
       Sphere{placed({0, 0, 0}, 1), 1, -0.3f, 0.8f, 4, false},
       {0.1f, 0.2f, 0}},
      {"ellipsoid from inside", full_sphere(squashed, 1), {0.3f, 0.1f, 0.1f}},
      {"disk", Disk{placed({0, 0, 0}, 1), 0.1f, 1, 0, 2 * pi, false}, {0.5f, 0.5f, 1}},
      {"annulus", Disk{squashed, 0.1f, 1, 0.4f, 4, false}, {0.2f, -0.5f, 0.9f}},
      {"rectangle",
       BilinearMesh({{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}}, {},
                    {}, false),
       {0.9f, 0.4f, 0.3f}},
      {"rectangle of triangles",
       TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                    {{1, 2, 0}, {2, 3, 0}}, {}, {}, false),
       {-0.8f, 0.2f, -0.4f}},
      {"two triangles that are no rectangle",
       TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0.5f}, {-1, 1, 0}},
                    {{0, 1, 2}, {0, 2, 3}}, {}, {}, false),
       {-0.8f, 0.2f, -0.4f}},
      {"trapezoid",
       BilinearMesh({{-1, -1, 0}, {1, -1, 0}, {-0.3f, 1, 0}, {0.4f, 1, 0}}, {{0, 1, 2, 3}},
                    {}, {}, false),
       {0, 0.4f, 0.7f}},
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

/// The weights of directions in each cell of a grid on the sphere.
class Histogram {
 public:
  static constexpr int rows = 6, columns = 12;

  void add(Vec3 wi, double weight) {
    const auto row = static_cast<size_t>(std::min(0.5f * (wi.z + 1) * rows, rows - 1.0f));
    const float phi = std::atan2(wi.y, wi.x) + pi;
    const auto column =
        static_cast<size_t>(std::min(phi / (2 * pi) * columns, columns - 1.0f));
    sums_[row * columns + column] += weight;
    squares_[row * columns + column] += weight * weight;
    mass.add(weight);
    for (int i = 0; i < 3; ++i)
      moments[static_cast<size_t>(i)].add(weight * static_cast<double>(wi[i]));
  }

  double mean(size_t cell) const { return sums_[cell] / count(); }
  /// Variance of mean().
  double variance(size_t cell) const {
    return (squares_[cell] / count() - mean(cell) * mean(cell)) / count();
  }

  RunningMoments mass;
  std::vector<RunningMoments> moments = std::vector<RunningMoments>(3);

 private:
  double count() const { return static_cast<double>(mass.count()); }

  std::vector<double> sums_ = std::vector<double>(rows * columns), squares_ = sums_;
};

// The density jumps at the silhouette, which rules out quadrature for chi_square_sphere();
// both sides are samples instead: directions from sample_direction(), and uniform ones with
// the density as weight.
TEST(SampleDirection, AgreesWithItsDensity) {
  constexpr int n = 40'000;
  const std::vector<Case> all = cases();
  const double level = sidak(
      0.01, static_cast<int>(all.size()) * (Histogram::rows * Histogram::columns + 4));
  for (const Case& c : all) {
    SCOPED_TRACE(c.name);
    const Intersector intersector = intersector_of(c.shape);
    RandomStream random(11);
    Histogram drawn, weighted;
    int missing = 0, of_zero_pdf = 0;
    for (int i = 0; i < n; ++i) {
      if (const auto sample = sample_direction(c.shape, c.from, random.next_2d())) {
        drawn.add(normalize(sample->point.p - c.from), 1);
        if (!(direction_pdf(c.shape, c.from, sample->point) > 0)) ++of_zero_pdf;
        EXPECT_EQ(direction_pdf(c.shape, c.from, sample->point), sample->pdf);
      } else {
        ++missing;
      }
      const Vec3 wi = random_direction(random);
      weighted.add(wi, total_pdf(c, intersector, wi) / static_cast<double>(inv_4pi));
    }
    EXPECT_EQ(missing, 0);
    EXPECT_EQ(of_zero_pdf, 0);
    EXPECT_GT(z_p_value(weighted.mass, 1), level) << weighted.mass.mean();
    for (size_t i = 0; i < Histogram::rows * Histogram::columns; ++i) {
      const double a = drawn.mean(i), b = weighted.mean(i);
      if (a * n < 25 && b * n < 25) continue;
      const double deviation = std::sqrt(drawn.variance(i) + weighted.variance(i));
      EXPECT_GT(z_p_value(a - b, deviation, 0), level) << i << ": " << a << " and " << b;
    }
    for (size_t i = 0; i < 3; ++i)
      EXPECT_GT(welch_p_value(drawn.moments[i], weighted.moments[i]), level)
          << i << ": " << drawn.moments[i].mean() << " and " << weighted.moments[i].mean();
  }
}

// The solid angle by the formula for a rectangle seen from above its center, 4 asin of the
// product of the sines of half the angles it fills.
TEST(SampleDirection, FindsTheSolidAngleOfARectangle) {
  for (const float distance : {0.01f, 0.3f, 1.0f, 10.0f, 100.0f}) {
    const Shape patch = BilinearMesh({{-1, -2, 0}, {1, -2, 0}, {-1, 2, 0}, {1, 2, 0}},
                                     {{0, 1, 2, 3}}, {}, {}, false);
    const Shape triangles = TriangleMesh({{-1, -2, 0}, {1, -2, 0}, {1, 2, 0}, {-1, 2, 0}},
                                         {{0, 1, 2}, {2, 3, 0}}, {}, {}, false);
    const auto h = static_cast<double>(distance);
    const double expected = 1 / (4 * std::asin(2 / std::sqrt((h * h + 1) * (h * h + 4))));
    for (const Shape& shape : {patch, triangles}) {
      const auto sample = sample_direction(shape, {0, 0, distance}, {0.3f, 0.6f});
      ASSERT_TRUE(sample);
      EXPECT_NEAR(static_cast<double>(sample->pdf), expected, 1e-5 * expected);
    }
  }
}

TEST(SampleDirection, IsEmptyInThePlaneOfARectangle) {
  const Shape patch = BilinearMesh({{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}},
                                   {{0, 1, 2, 3}}, {}, {}, false);
  for (const Vec3 from : {Vec3{3, 0, 0}, Vec3{0.2f, 0.3f, 0}, Vec3{1, 1, 0}})
    EXPECT_FALSE(sample_direction(patch, from, {0.5f, 0.5f}));
}

}  // namespace
}  // namespace tyndall
