// SPDX-License-Identifier: Apache-2.0
// Shapes that only a share of the rays meets.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/geometry/test_shapes.h"
#include "tyndall/geometry/intersector.h"

namespace tyndall {
namespace {

constexpr float alpha = 0.3f;
constexpr int rays = 40'000;

Ray random_ray(RandomStream& random) {
  return {{0.2f * random.next_1d(), 0.2f * random.next_1d(), -3}, {0.05f, 0.01f, 1}};
}

/// The share of rays that meet anything; all queries of a ray must agree.
double share_met(const Intersector& intersector) {
  RandomStream random(5);
  int met = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = random_ray(random);
    Crossings crossings;
    const auto hit = intersector.intersect(ray, infinity, RayMask::all);
    const auto through = intersector.find_through(ray, infinity, RayMask::all, crossings);
    EXPECT_EQ(hit.has_value(), through.has_value());
    EXPECT_EQ(hit.has_value(), intersector.is_occluded(ray, infinity, RayMask::opaque));
    if (!hit) continue;
    ++met;
    EXPECT_EQ(hit->t, through->t);
    EXPECT_LT(distance(hit->point.p, ray.at(hit->t)), 1e-5f);
    EXPECT_FALSE(intersector.is_occluded(ray, hit->t * 0.999f, RayMask::opaque));
    EXPECT_TRUE(intersector.is_occluded(ray, hit->t * 1.001f, RayMask::opaque));
  }
  return static_cast<double>(met) / rays;
}

// Within four standard errors.
void expect_share(const Intersector& intersector, double expected) {
  EXPECT_NEAR(share_met(intersector), expected,
              4 * std::sqrt(expected * (1 - expected) / rays));
}

double of_several(int hits) { return 1 - std::pow(1 - double{alpha}, hits); }

Intersector translucent(const Shape& shape) {
  const std::vector<Intersector::Group> groups{{{&shape, false, alpha}}};
  return Intersector(groups, {});
}

TEST(TranslucentTest, MeshesAndPatches) {
  expect_share(translucent(TriangleMesh({{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}}, {{0, 1, 2}},
                                        {}, {}, false)),
               of_several(1));
  expect_share(translucent(box_mesh({0, 0, 0}, {1, 1, 1})), of_several(2));
  expect_share(translucent(BilinearMesh({{-1, -1, 3}, {1, -1, 3}, {-1, 1, 3}, {1, 1, 3}},
                                        {{0, 1, 2, 3}}, {}, {}, false)),
               of_several(1));
}

TEST(TranslucentTest, BothSidesOfASphere) {
  expect_share(translucent(Sphere{.world_from_sphere = Transform(),
                                  .radius = 2,
                                  .z_min = -2,
                                  .z_max = 2,
                                  .phi_max = 2 * pi,
                                  .flip_normals = false}),
               of_several(2));
}

// Each decides for itself, and what is behind is met by the rest.
TEST(TranslucentTest, SeveralAndInstances) {
  const Shape box = box_mesh({0, 0, 0}, {1, 1, 1}), wall = box_mesh({0, 0, 9}, {9, 9, 1});
  const std::vector<Intersector::Group> groups{{{&wall, false, alpha}},
                                               {{&box, false, alpha}}};
  const std::vector<Intersector::Instance> instances{{1, Transform()},
                                                     {1, Transform::translate({0, 0, 4})}};
  expect_share(Intersector(groups, instances), of_several(6));
}

TEST(TranslucentTest, BoundariesAreMetByAll) {
  const Shape box = box_mesh({0, 0, 0}, {1, 1, 1});
  const std::vector<Intersector::Group> groups{{{&box, true, alpha}}};
  const Intersector intersector(groups, {});
  RandomStream random(6);
  for (int i = 0; i < 100; ++i)
    EXPECT_TRUE(intersector.intersect(random_ray(random), infinity, RayMask::all));
}

}  // namespace
}  // namespace tyndall
