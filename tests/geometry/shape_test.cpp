// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/geometry/test_shapes.h"
#include "tyndall/geometry/intersector.h"

namespace tyndall {
namespace {

const std::vector<Vec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};

Sphere sphere(const Transform& t, float radius) {
  return {t, radius, -radius, radius, 2 * pi, false};
}

void expect_near(Vec3 a, Vec3 b, float tolerance) {
  EXPECT_LT(distance(a, b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(TriangleMesh, OutsideSeesTheCornersCounterclockwise) {
  const TriangleMesh mesh(triangle, {{0, 1, 2}}, {}, {}, false);
  expect_near(mesh.point(0, {0.2f, 0.3f}).ng, {0, 0, 1}, 1e-6f);
  expect_near(mesh.point(0, {0.2f, 0.3f}).ns, {0, 0, 1}, 1e-6f);
  const TriangleMesh flipped(triangle, {{0, 1, 2}}, {}, {}, true);
  expect_near(flipped.point(0, {0.2f, 0.3f}).ng, {0, 0, -1}, 1e-6f);
}

TEST(TriangleMesh, GivenNormalsDecideTheOutside) {
  const std::vector<Vec3> normals{{0, 0, -2}, {3, 0, -3}, {0, 0, -1}};
  for (const bool flip : {false, true}) {
    const TriangleMesh mesh(triangle, {{0, 1, 2}}, normals, {}, flip);
    const SurfacePoint at_p1 = mesh.point(0, {1, 0});
    expect_near(at_p1.ng, {0, 0, -1}, 1e-6f);
    expect_near(at_p1.ns, normalize(Vec3{1, 0, -1}), 1e-6f);
  }
}

TEST(TriangleMesh, InterpolatesPositionsAndTextureCoordinates) {
  const TriangleMesh plain(triangle, {{0, 1, 2}}, {}, {}, false);
  expect_near(plain.point(0, {0.25f, 0.5f}).p, {0.25f, 0.5f, 0}, 1e-7f);
  // pbrt's own: (0,0), (1,0), (1,1).
  EXPECT_EQ(plain.point(0, {0.25f, 0.5f}).uv, (Vec2{0.75f, 0.5f}));
  const TriangleMesh textured(triangle, {{2, 0, 1}}, {}, {{1, 0}, {0, 2}, {4, 4}}, false);
  EXPECT_EQ(textured.point(0, {0.25f, 0.5f}).uv, (Vec2{1.25f, 2}));
}

TEST(Sphere, OutsideIsAwayFromTheCenterAlsoIfMirrored) {
  for (const float mirror : {1.0f, -1.0f})
    for (const bool flip : {false, true}) {
      Sphere s =
          sphere(Transform::translate({1, 2, 3}) * Transform::scale({mirror, 1, 2}), 1);
      s.flip_normals = flip;
      RandomStream random(1);
      for (int i = 0; i < 100; ++i) {
        const SurfacePoint on = s.point(0, random.next_2d());
        EXPECT_GT((flip ? -1.0f : 1.0f) * dot(on.ng, on.p - Vec3{1, 2, 3}), 0);
        EXPECT_EQ(on.ns, on.ng);
        EXPECT_NEAR(length(on.ng), 1, 1e-6f);
      }
    }
}

TEST(Sphere, HasTheParametersOfPbrt) {
  const Sphere s = sphere(Transform(), 2);
  expect_near(s.point(0, {0, 0.5f}).p, {2, 0, 0}, 1e-6f);
  expect_near(s.point(0, {0.25f, 0.5f}).p, {0, 2, 0}, 1e-6f);
  expect_near(s.point(0, {0, 0}).p, {0, 0, -2}, 1e-6f);
  expect_near(s.point(0, {0, 1}).p, {0, 0, 2}, 1e-6f);
  const Sphere part{Transform(), 2, 0, 1, pi, false};
  expect_near(part.point(0, {0.5f, 0}).p, {0, 2, 0}, 1e-6f);
  expect_near(part.point(0, {1, 1}).p, {-std::sqrt(3.0f), 0, 1}, 1e-6f);
}

TEST(Disk, HasTheNormalAndParametersOfPbrt) {
  const Disk d{Transform(), 3, 2, 1, pi, false};
  expect_near(d.point(0, {0.5f, 0}).p, {0, 2, 3}, 1e-6f);
  expect_near(d.point(0, {0, 1}).p, {1, 0, 3}, 1e-6f);
  expect_near(d.point(0, {0, 1}).ng, {0, 0, 1}, 1e-6f);
  const Disk flipped{Transform(), 3, 2, 1, pi, true};
  expect_near(flipped.point(0, {0, 1}).ng, {0, 0, -1}, 1e-6f);
}

TEST(BilinearMesh, OutsideIsTheCrossProductOfTheDerivatives) {
  const BilinearMesh plain(square, {{0, 1, 2, 3}}, {}, {}, false);
  expect_near(plain.point(0, {0.25f, 0.5f}).p, {0.25f, 0.5f, 0}, 1e-7f);
  expect_near(plain.point(0, {0.25f, 0.5f}).ng, {0, 0, 1}, 1e-6f);
  EXPECT_EQ(plain.point(0, {0.25f, 0.5f}).uv, (Vec2{0.25f, 0.5f}));
  const BilinearMesh flipped(square, {{0, 1, 2, 3}}, {}, {}, true);
  expect_near(flipped.point(0, {0.25f, 0.5f}).ng, {0, 0, -1}, 1e-6f);
  const std::vector<Vec3> down(4, Vec3{0, 0, -1});
  const BilinearMesh smooth(square, {{0, 1, 2, 3}}, down, {{1, 1}, {3, 1}, {1, 2}, {3, 2}},
                            false);
  expect_near(smooth.point(0, {0.25f, 0.5f}).ng, {0, 0, -1}, 1e-6f);
  EXPECT_EQ(smooth.point(0, {0.25f, 0.5f}).uv, (Vec2{1.5f, 1.5f}));
}

TEST(Area, AgreesWithClosedForms) {
  const Transform doubled = Transform::translate({1, 2, 3}) *
                            Transform::rotate(40, {1, 2, 3}) * Transform::scale({2, 2, -2});
  EXPECT_NEAR(area(box_mesh({1, 2, 3}, {1, 2, 3})), 88, 1e-4f);
  EXPECT_NEAR(area(sphere(doubled, 1)), 16 * pi, 1e-4f);
  EXPECT_NEAR(area(Sphere{doubled, 1, 0.5f, -0.25f, 1, false}), 4 * 0.75f, 1e-5f);
  EXPECT_NEAR(area(Sphere{doubled, 1, -9, 9, 9, false}), 16 * pi, 1e-4f);
  EXPECT_TRUE((Sphere{doubled, 1, -9, 9, radians(360), false}.is_full()));
  EXPECT_NEAR(area(Disk{doubled, 1, 3, 1, 1, false}), 4 * 4, 1e-4f);
  EXPECT_NEAR(area(Disk{Transform::scale({2, 3, 5}), 1, 1, 0, 2 * pi, false}), 6 * pi,
              1e-4f);
  // An oblate spheroid of half axes 1, 1, c has the area 2 pi (1 + c^2 / e atanh(e)).
  const double c = 0.5, e = std::sqrt(1 - c * c);
  EXPECT_NEAR(static_cast<double>(area(sphere(Transform::scale({1, 1, 0.5f}), 1))),
              2 * 3.14159265358979 * (1 + c * c / e * std::atanh(e)), 1e-3);
  EXPECT_NEAR(area(BilinearMesh(square, {{0, 1, 2, 3}}, {}, {}, false)), 1, 1e-6f);
  EXPECT_NEAR(area(BilinearMesh({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                                {{0, 1, 2, 3}}, {}, {}, false)),
              1.5f, 1e-6f);
  EXPECT_EQ(area(TriangleMesh({}, {}, {}, {}, false)), 0);
}

TEST(Area, OfASaddleIsThatOfManyTriangles) {
  const BilinearMesh saddle({{-1, -1, -0.5f}, {1, -1, 0.5f}, {-1, 1, 0.5f}, {1, 1, -0.5f}},
                            {{0, 1, 2, 3}}, {}, {}, false);
  constexpr int n = 200;
  std::vector<Vec3> positions;
  std::vector<Vec3i> triangles;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      positions.push_back(
          saddle.point(0, {static_cast<float>(x) / n, static_cast<float>(y) / n}).p);
      const int i = y * (n + 1) + x;
      if (x == n || y == n) continue;
      triangles.push_back({i, i + 1, i + n + 2});
      triangles.push_back({i, i + n + 2, i + n + 1});
    }
  EXPECT_NEAR(area(saddle), area(TriangleMesh(positions, triangles, {}, {}, false)), 1e-4f);
}

TEST(Bounds, HoldEveryPointAndLittleMore) {
  RandomStream random(2);
  for (int i = 0; i < 10; ++i) {
    const Transform t = random_transform(random, i % 2 == 1);
    const Shape shapes[] = {transformed(box_mesh({0, 0, 0}, {1, 2, 3}), t), sphere(t, 1),
                            Disk{t, 0.5f, 1, 0.5f, 2 * pi, false}};
    for (const Shape& shape : shapes) {
      const Bounds3 b = bounds(shape);
      Bounds3 seen;
      for (int j = 0; j < 20'000; ++j) {
        // Parameters cover the extremes of a mesh by its corners only.
        const Vec2 u = random.next_2d();
        const auto* mesh = std::get_if<TriangleMesh>(&shape);
        const SurfacePoint on =
            mesh ? mesh->point(static_cast<uint32_t>(j % 12),
                               {j % 3 == 1 ? 1.0f : 0.0f, j % 3 == 2 ? 1.0f : 0.0f})
                 : surface_point(shape, 0,
                                 {u.x, std::holds_alternative<Disk>(shape) ? 0 : u.y});
        EXPECT_TRUE(b.contains(on.p));
        seen.extend(on.p);
      }
      EXPECT_LT(length(b.diagonal() - seen.diagonal()), 0.05f * length(b.diagonal()));
    }
  }
  const Bounds3 cap =
      bounds(Sphere{Transform::translate({0, 0, 5}), 1, 0.5f, 1, 2 * pi, false});
  EXPECT_NEAR(cap.min.z, 5.5f, 1e-6f);
  EXPECT_NEAR(cap.max.z, 6, 1e-6f);
  EXPECT_TRUE(bounds(TriangleMesh({}, {}, {}, {}, false)).is_empty());
  EXPECT_TRUE(bounds(BilinearMesh({}, {}, {}, {}, false)).is_empty());
}

TEST(SurfacePoint, OfAHitIsTheHitPoint) {
  RandomStream random(3);
  const Transform t = random_transform(random);
  const Shape shapes[] = {
      transformed(sphere_mesh({0, 0, 0}, 1, 6, 8), t), sphere(t, 1),
      Sphere{t, 1, -0.3f, 0.8f, 4, false}, Disk{t, 0.1f, 1, 0.2f, 5, false},
      BilinearMesh({{-1, -1, -0.5f}, {1, -1, 0.5f}, {-1, 1, 0.5f}, {1, 1, -0.5f}},
                   {{0, 1, 2, 3}}, {}, {}, false)};
  for (const Shape& shape : shapes) {
    const std::vector<Intersector::Group> groups{{{&shape, false}}};
    const Intersector intersector(groups, {});
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 o = random_in_cube(random) * 8;
      const Vec3 target = sample_area(shape, random.next_2d()).point.p;
      const Ray ray{o, normalize(target - o)};
      const auto hit = intersector.intersect(ray, infinity, RayMask::all);
      if (!hit) continue;
      ++hits;
      // What is off across the ray is stretched along a surface that it grazes.
      const float cos = abs_dot(hit->point.ng, ray.d);
      EXPECT_LT(distance(hit->point.p, ray.at(hit->t)) * cos, 2e-6f);
      // Of the nearest point of all layers, at most as far as the one aimed at.
      EXPECT_LT(hit->t, distance(target, o) + 1e-4f);
      if (std::holds_alternative<TriangleMesh>(shape)) continue;
      if (std::holds_alternative<BilinearMesh>(shape))
        expect_near(surface_point(shape, 0, hit->point.uv).p, hit->point.p, 1e-6f);
      else
        expect_near(surface_point(shape, 0, hit->point.uv).p, hit->point.p, 5e-6f);
    }
    EXPECT_GT(hits, 990);
  }
}

}  // namespace
}  // namespace tyndall
