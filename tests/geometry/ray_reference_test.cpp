// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/geometry/test_shapes.h"
#include "tyndall/geometry/intersector.h"
#include "tyndall/geometry/ray_intersection.h"

namespace tyndall {
namespace {

/// A hit by brute force, and how clearly it is one.
struct Reference {
  double t = std::numeric_limits<double>::infinity();
  size_t shape = 0;
  bool is_doubtful =
      false;  // a ray so close to an edge or a silhouette that rounding decides
};

/// Solves for distance and barycentric coordinates by Cramer's rule.
void meet_triangle(const PreciseTriangle& triangle, const PreciseRay& ray, size_t shape,
                   Reference& nearest) {
  const Vec3d n = cross(triangle.edge1, triangle.edge2);
  const double det = -dot(ray.d, n);
  const Vec3d o = ray.o - triangle.p0;
  const double t = dot(o, n) / det;
  const double b1 = dot(cross(o, triangle.edge2), ray.d) / -det;
  const double b2 = dot(cross(triangle.edge1, o), ray.d) / -det;
  const double inside = std::min({b1, b2, 1 - b1 - b2});
  if (!(t > 0)) return;
  if (std::abs(inside) < 1e-4 && t < nearest.t + 1) nearest.is_doubtful = true;
  if (inside < 0 || t >= nearest.t) return;
  nearest.t = t;
  nearest.shape = shape;
}

/// The textbook quadratic equation, in long double.
void meet_sphere(Vec3d center, double radius, const PreciseRay& ray, size_t shape,
                 Reference& nearest) {
  const Vec3d o = ray.o - center;
  const long double a = dot(ray.d, ray.d), b = dot(o, ray.d),
                    c = dot(o, o) - radius * radius;
  const long double discriminant = b * b - a * c;
  if (std::abs(discriminant) < 1e-5L) nearest.is_doubtful = true;
  if (discriminant < 0) return;
  for (const long double sign : {-1.0L, 1.0L}) {
    const auto t = static_cast<double>((-b + sign * std::sqrt(discriminant)) / a);
    if (!(t > 0) || t >= nearest.t) continue;
    nearest.t = t;
    nearest.shape = shape;
  }
}

PreciseRay precise(const Ray& ray) { return {Vec3d(ray.o), Vec3d(ray.d)}; }

TEST(RayReference, TrianglesAndSpheresAreHitWhereBruteForceSays) {
  RandomStream random(1);
  int hits = 0, rays = 0, doubtful = 0;
  for (int scene = 0; scene < 100; ++scene) {
    std::vector<Shape> shapes;
    for (int i = 0; i < 8; ++i) {
      std::vector<Vec3> corners;
      for (int j = 0; j < 12; ++j) corners.push_back(random_in_cube(random));
      shapes.emplace_back(TriangleMesh(
          corners, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}, {}, {}, false));
    }
    std::vector<Vec3> centers;
    for (int i = 0; i < 4; ++i) {
      centers.push_back(random_in_cube(random));
      shapes.emplace_back(Sphere{Transform::translate(centers.back()), 0.25f, -0.25f, 0.25f,
                                 2 * pi, false});
    }
    std::vector<Intersector::Group> groups(1);
    for (const Shape& shape : shapes) groups[0].push_back({&shape, false});
    const Intersector intersector(groups, {});
    for (int i = 0; i < 1000; ++i) {
      const Vec3 o = random_in_cube(random) * 2;
      const Ray ray{o, normalize(random_in_cube(random) - o)};
      Reference expected;
      for (size_t s = 0; s < shapes.size(); ++s)
        if (const auto* mesh = std::get_if<TriangleMesh>(&shapes[s]))
          for (uint32_t k = 0; k < 4; ++k)
            meet_triangle(mesh->triangle(k), precise(ray), s, expected);
        else
          meet_sphere(Vec3d(centers[s - 8]), 0.25, precise(ray), s, expected);
      ++rays;
      if (expected.is_doubtful) {
        ++doubtful;
        continue;
      }
      const auto hit = intersector.intersect(ray, infinity, RayMask::all);
      ASSERT_EQ(hit.has_value(), std::isfinite(expected.t));
      EXPECT_EQ(hit.has_value(), intersector.is_occluded(ray, infinity, RayMask::all));
      if (!hit) continue;
      ++hits;
      EXPECT_EQ(hit->shape, expected.shape);
      EXPECT_NEAR(static_cast<double>(hit->t), expected.t, 3e-7 * expected.t + 1e-12);
      const auto t = static_cast<float>(expected.t);
      EXPECT_FALSE(intersector.is_occluded(ray, t * 0.999f, RayMask::all));
      EXPECT_TRUE(intersector.is_occluded(ray, t * 1.001f, RayMask::all));
    }
  }
  EXPECT_EQ(rays, 100'000);
  EXPECT_GT(hits, 30'000);
  EXPECT_LT(doubtful, 2'000);
}

/// A patch as many small triangles.
TriangleMesh tessellated(const BilinearMesh& mesh, int n) {
  std::vector<Vec3> positions;
  std::vector<Vec3i> triangles;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      positions.push_back(mesh.point(0, {static_cast<float>(x) / static_cast<float>(n),
                                         static_cast<float>(y) / static_cast<float>(n)})
                              .p);
      const int i = y * (n + 1) + x;
      if (x == n || y == n) continue;
      triangles.push_back({i, i + 1, i + n + 2});
      triangles.push_back({i, i + n + 2, i + n + 1});
    }
  return {positions, triangles, {}, {}, false};
}

TEST(RayReference, PatchesAreHitWhereManyTrianglesAre) {
  RandomStream random(2);
  int hits = 0, differing = 0, rays = 0;
  for (int scene = 0; scene < 20; ++scene) {
    std::vector<Vec3> corners{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};
    for (Vec3& corner : corners) corner += random_in_cube(random) * 0.7f;
    const Shape patch = BilinearMesh(corners, {{0, 1, 2, 3}}, {}, {}, false);
    const Shape triangles = tessellated(std::get<BilinearMesh>(patch), 128);
    const std::vector<Intersector::Group> groups{{{&patch, false}}},
        reference{{{&triangles, false}}};
    const Intersector a(groups, {}), b(reference, {});
    for (int i = 0; i < 1000; ++i) {
      const Vec3 o = random_in_cube(random) * 3;
      const Ray ray{o, normalize(random_in_cube(random) - o)};
      const auto hit = a.intersect(ray, infinity, RayMask::all);
      const auto expected = b.intersect(ray, infinity, RayMask::all);
      ++rays;
      if (hit.has_value() != expected.has_value()) {
        ++differing;
        continue;
      }
      if (!hit) continue;
      ++hits;
      const float cos = abs_dot(hit->point.ng, ray.d);
      if (magnitude(hit->t - expected->t) * cos > 1e-3f) ++differing;
    }
  }
  // The rest grazes an edge or a silhouette, where triangles cut the corners.
  EXPECT_LT(differing, rays / 500);
  EXPECT_GT(hits, rays / 3);
}

/// pbrt's rules for partial quadrics: the first hit that is not clipped away.
TEST(RayReference, ClippedSpheresAreHitAsUnclippedOnesButForTheClips) {
  RandomStream random(3);
  const Sphere part{Transform(), 1, -0.4f, 0.7f, 4, false};
  const Shape shape = part;
  const std::vector<Intersector::Group> groups{{{&shape, false}}};
  const Intersector intersector(groups, {});
  int hits = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 o = random_in_cube(random) * 2;
    const Ray ray{o, normalize(random_in_cube(random) - o)};
    const PreciseRay line = precise(ray);
    const Vec3d p0 = line.o, d = line.d;
    const double a = dot(d, d), b = dot(p0, d),
                 discriminant = b * b - a * (dot(p0, p0) - 1);
    std::optional<double> expected;
    bool is_doubtful = std::abs(discriminant) < 1e-5;
    for (const double sign : {-1.0, 1.0}) {
      const double t = (-b + sign * std::sqrt(discriminant)) / a;
      const Vec3d p = line.at(t);
      const double phi = std::atan2(p.y, p.x) + (p.y < 0 ? 6.283185307179586 : 0);
      for (const double margin : {p.z + 0.4, p.z - 0.7, phi - 4, p.x > 0 ? p.y : 1.0})
        if (std::abs(margin) < 1e-5) is_doubtful = true;
      if (!expected && t > 0 && p.z > -0.4 && p.z < 0.7 && phi < 4) expected = t;
    }
    if (is_doubtful) continue;
    const auto hit = intersector.intersect(ray, infinity, RayMask::all);
    ASSERT_EQ(hit.has_value(), expected.has_value());
    EXPECT_EQ(hit.has_value(), intersector.is_occluded(ray, infinity, RayMask::all));
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(static_cast<double>(hit->t), *expected, 1e-6);
  }
  EXPECT_GT(hits, 4000);
}

}  // namespace
}  // namespace tyndall
