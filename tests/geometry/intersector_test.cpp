// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/intersector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "tests/geometry/test_shapes.h"

namespace tyndall {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Intersector one_shape(const Shape& shape, bool is_boundary = false) {
  const std::vector<Intersector::Group> groups{{{&shape, is_boundary}}};
  return Intersector(groups, {});
}

TEST(Intersector, FindsTheNearestOfTwoTriangles) {
  const Shape near =
      TriangleMesh({{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, {{0, 1, 2}}, {}, {}, false);
  const Shape far =
      TriangleMesh({{-1, -1, 3}, {1, -1, 3}, {0, 1, 3}}, {{0, 1, 2}}, {}, {}, false);
  const std::vector<Intersector::Group> groups{{{&far, false}, {&near, false}}};
  const Intersector intersector(groups, {});
  const Ray ray{{0, 0, 0}, {0, 0, 1}};
  const auto hit = intersector.intersect(ray, infinity, RayMask::opaque);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 1);
  EXPECT_EQ(hit->group, 0u);
  EXPECT_EQ(hit->shape, 1u);
  EXPECT_LT(distance(hit->point.p, {0, 0, 1}), 1e-6f);
  EXPECT_EQ(hit->point.ng, (Vec3{0, 0, 1}));
  const auto behind =
      intersector.intersect({{0, 0, 2}, {0, 0, 1}}, infinity, RayMask::opaque);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->shape, 0u);
  EXPECT_FALSE(intersector.intersect(ray, 0.999f, RayMask::opaque));
  EXPECT_FALSE(intersector.is_occluded(ray, 0.999f, RayMask::opaque));
  EXPECT_TRUE(intersector.is_occluded(ray, 1.001f, RayMask::opaque));
}

TEST(Intersector, MasksSeparateBoundariesFromOpaqueShapes) {
  const Shape wall = box_mesh({0, 0, 5}, {1, 1, 1});
  const Shape fog = Sphere{.world_from_sphere = Transform(),
                           .radius = 2,
                           .z_min = -2,
                           .z_max = 2,
                           .phi_max = 2 * pi,
                           .flip_normals = false};
  const Shape quad = BilinearMesh({{-1, -1, 3}, {1, -1, 3}, {-1, 1, 3}, {1, 1, 3}},
                                  {{0, 1, 2, 3}}, {}, {}, false);
  const std::vector<Intersector::Group> groups{
      {{&wall, false}, {&fog, true}, {&quad, true}}};
  const Intersector intersector(groups, {});
  const Ray ray{{0.1f, 0.2f, 0}, {0, 0, 1}};
  EXPECT_EQ(intersector.intersect(ray, infinity, RayMask::opaque)->shape, 0u);
  EXPECT_EQ(intersector.intersect(ray, infinity, RayMask::boundary)->shape, 1u);
  EXPECT_EQ(intersector.intersect(ray, infinity, RayMask::all)->shape, 1u);
  EXPECT_FALSE(intersector.is_occluded(ray, 3.5f, RayMask::opaque));
  EXPECT_TRUE(intersector.is_occluded(ray, 3.5f, RayMask::boundary));
  EXPECT_FALSE(intersector.is_occluded(ray, 1.5f, RayMask::all));
  EXPECT_TRUE(intersector.is_occluded(ray, 4.5f, RayMask::opaque));
}

TEST(Intersector, MasksReachIntoInstances) {
  const Shape wall = box_mesh({0, 0, 5}, {1, 1, 1});
  const Shape fog = box_mesh({0, 0, 3}, {1, 1, 0.5f});
  const std::vector<Intersector::Group> groups{{}, {{&wall, false}, {&fog, true}}};
  const std::vector<Intersector::Instance> instances{{1, Transform()}};
  const Intersector intersector(groups, instances);
  const Ray ray{{0.1f, 0.2f, 0}, {0, 0, 1}};
  EXPECT_EQ(intersector.intersect(ray, infinity, RayMask::opaque)->shape, 0u);
  EXPECT_EQ(intersector.intersect(ray, infinity, RayMask::boundary)->shape, 1u);
  EXPECT_EQ(intersector.intersect(ray, infinity, RayMask::all)->group, 1u);
  EXPECT_FALSE(intersector.is_occluded(ray, 3.8f, RayMask::opaque));
}

TEST(Intersector, RaysThatAreNotFiniteHitNothing) {
  const Shape shapes[] = {box_mesh({0, 0, 0}, {1, 1, 1}),
                          Sphere{Transform(), 1, -1, 1, 2 * pi, false},
                          Disk{Transform(), 0.5f, 1, 0, 2 * pi, false},
                          BilinearMesh({{-1, -1, 0}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 0}},
                                       {{0, 1, 2, 3}}, {}, {}, false)};
  std::vector<Intersector::Group> groups(2);
  for (const Shape& shape : shapes) {
    groups[0].push_back({&shape, false});
    groups[1].push_back({&shape, true});
  }
  const std::vector<Intersector::Instance> instances{{1, Transform::scale({2, 2, 2})}};
  const Intersector intersector(groups, instances);
  const float bad[] = {nan, infinity, -infinity};
  for (const float x : bad)
    for (int i = 0; i < 3; ++i) {
      Ray origin{{0, 0, -5}, {0, 0, 1}}, direction = origin;
      origin.o[i] = x;
      direction.d[i] = x;
      EXPECT_FALSE(intersector.intersect(origin, infinity, RayMask::all));
      EXPECT_FALSE(intersector.intersect(direction, infinity, RayMask::all));
      EXPECT_FALSE(intersector.is_occluded(origin, infinity, RayMask::all));
      EXPECT_FALSE(intersector.is_occluded(direction, infinity, RayMask::all));
    }
  const Ray ray{{0.1f, 0.1f, -5}, {0, 0, 1}};
  EXPECT_TRUE(intersector.intersect(ray, infinity, RayMask::all));
  for (const float t_max : {nan, -infinity, -1.0f, 0.0f}) {
    EXPECT_FALSE(intersector.intersect(ray, t_max, RayMask::all));
    EXPECT_FALSE(intersector.is_occluded(ray, t_max, RayMask::all));
  }
  EXPECT_FALSE(
      intersector.intersect({{0.1f, 0.1f, -5}, {0, 0, 0}}, infinity, RayMask::all));
  const Ray far{{3e38f, -3e38f, 3e38f}, normalize(Vec3{-1, 1, -1})};
  EXPECT_FALSE(intersector.is_occluded(far, 1, RayMask::all));
}

TEST(Intersector, DegenerateShapesAreNeverHit) {
  const Shape shapes[] = {
      TriangleMesh({}, {}, {}, {}, false),
      TriangleMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {nan, 0, 0}, {0, infinity, 0}},
                   {{0, 0, 0}, {0, 1, 2}, {0, 1, 3}, {0, 1, 4}}, {}, {}, false),
      Sphere{Transform(), 0, 0, 0, 2 * pi, false},
      Sphere{Transform(), 1, 0.5f, 0.5f, 2 * pi, false},
      Sphere{Transform(), -1, -1, 1, 2 * pi, false},
      Sphere{Transform(), nan, -1, 1, 2 * pi, false},
      Disk{Transform(), 0, 0, 0, 2 * pi, false},
      Disk{Transform(), nan, 1, 0, 2 * pi, false},
      Disk{Transform(), 0, 1, 2, 2 * pi, false},
      BilinearMesh({}, {}, {}, {}, false),
      BilinearMesh({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {nan, 1, 1}},
                   {{0, 1, 2, 0}, {0, 1, 2, 3}}, {}, {}, false)};
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(&shape - shapes);
    const Intersector intersector = one_shape(shape);
    RandomStream random(1);
    for (int i = 0; i < 100; ++i) {
      const Vec3 o = random_in_cube(random) * 2;
      const Ray ray{o, normalize(-o)};
      EXPECT_FALSE(intersector.intersect(ray, infinity, RayMask::all));
      EXPECT_FALSE(intersector.is_occluded(ray, infinity, RayMask::all));
    }
    EXPECT_FALSE(sample_direction(shape, {3, 4, 5}, {0.5f, 0.5f}));
  }
  const Intersector empty({}, {});
  EXPECT_FALSE(empty.intersect({{0, 0, 0}, {0, 0, 1}}, infinity, RayMask::all));
  EXPECT_TRUE(empty.bounds().is_empty());
}

TEST(Intersector, BoundsHoldInstances) {
  const Shape box = box_mesh({0, 0, 0}, {1, 1, 1});
  const std::vector<Intersector::Group> groups{{{&box, false}}, {{&box, false}}};
  const std::vector<Intersector::Instance> instances{{1, Transform::translate({10, 0, 0})}};
  const Bounds3 b = Intersector(groups, instances).bounds();
  EXPECT_EQ(b.min, (Vec3{-1, -1, -1}));
  EXPECT_EQ(b.max, (Vec3{11, 1, 1}));
}

TEST(Intersector, AnInstanceIsHitWhereItsTransformedShapeIs) {
  RandomStream random(7);
  for (int scene = 0; scene < 20; ++scene) {
    const Transform world_from_group = random_transform(random, scene % 2 == 1);
    const TriangleMesh mesh = sphere_mesh({0.5f, 0, 0}, 1, 6, 8);
    const Shape grouped = mesh, direct = transformed(mesh, world_from_group);
    const std::vector<Intersector::Group> groups{{}, {{&grouped, false}}};
    const std::vector<Intersector::Instance> instances{{1, world_from_group}};
    const Intersector instanced(groups, instances);
    const Intersector plain = one_shape(direct);
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3 target = world_from_group.point(random_in_cube(random));
      const Vec3 o = random_in_cube(random) * 10;
      const Ray ray{o, normalize(target - o)};
      const auto a = instanced.intersect(ray, infinity, RayMask::all);
      const auto b = plain.intersect(ray, infinity, RayMask::all);
      EXPECT_EQ(a.has_value(), instanced.is_occluded(ray, infinity, RayMask::all));
      if (a.has_value() != b.has_value()) continue;  // a silhouette
      if (!a) continue;
      ++hits;
      EXPECT_EQ(a->group, 1u);
      EXPECT_NEAR(a->t, b->t, 2e-5f * (1 + b->t));
      EXPECT_GT(dot(a->point.ng, b->point.ng), 0.9999f);
      EXPECT_LT(distance(a->point.p, b->point.p), 1e-4f);
      EXPECT_LT(distance(a->point.p, ray.at(a->t)), 1e-4f);
    }
    EXPECT_GT(hits, 100);
  }
}

}  // namespace
}  // namespace tyndall
