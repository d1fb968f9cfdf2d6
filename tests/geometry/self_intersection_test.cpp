// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/geometry/test_shapes.h"
#include "tyndall/geometry/intersector.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace tyndall {
namespace {

constexpr std::array<float, 6> scales{1e-4f, 1e-2f, 1, 1e2f, 1e4f, 1e6f};
constexpr std::array<float, 5> cosines{1, 1e-1f, 1e-2f, 1e-3f, 1e-4f};

struct Scene {
  std::vector<Intersector::Group> groups;
  std::vector<Intersector::Instance> instances;
  Vec3 center;  // where the origin of the shape's space is
};

/// The shape itself, and as an instance under a transform.
std::vector<Scene> both_ways(const Shape& shape, const Transform& world_from_group) {
  return {{{{{&shape, false}}}, {}, {}},
          {{{}, {{&shape, false}}}, {{1, world_from_group}}, world_from_group.point({})}};
}

/// A rotation, a mirroring scale and a translation that suit a shape of the given size.
Transform placement(float size) {
  return Transform::translate({3 * size, -2 * size, size}) *
         Transform::rotate(70, {3, 2, 1}) * Transform::scale({2, -1, 0.5f});
}

/// A unit vector that makes an angle of the given cosine with `n`.
Vec3 at_cosine(Vec3 n, float cosine, RandomStream& random) {
  const Vec3 tangent = normalize(cross(n, random_direction(random)));
  return normalize(n * cosine + tangent * std::sqrt(1 - cosine * cosine));
}

/// Counts rays that leave a convex or flat shape and meet it again: from random hits, to
/// the side that the ray came from if `outward`, else to the other.
int self_hits(const Scene& scene, float size, bool outward) {
  const Intersector intersector(scene.groups, scene.instances);
  RandomStream random(3);
  int found = 0, hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 target = scene.center + random_in_cube(random) * size;
    const Vec3 o = scene.center + random_direction(random) * (4 * size);
    const auto hit =
        intersector.intersect({o, normalize(target - o)}, infinity, RayMask::all);
    if (!hit) continue;
    ++hits;
    for (const float cosine : cosines) {
      const bool same_side = (dot(hit->point.ng, o - hit->point.p) > 0) == outward;
      const Vec3 n = same_side ? hit->point.ng : -hit->point.ng;
      const Vec3 d = at_cosine(n, cosine, random);
      const Ray ray{offset_origin(hit->point.p, hit->point.ng, d), d};
      if (intersector.intersect(ray, infinity, RayMask::all)) ++found;
      if (intersector.is_occluded(ray, infinity, RayMask::all)) ++found;
    }
  }
  EXPECT_GT(hits, 200);
  return found;
}

TEST(SelfIntersection, NeverHappensOnConvexShapesFromOutside) {
  for (const float s : scales) {
    SCOPED_TRACE(s);
    const Transform t = Transform::rotate(35, {1, 2, 3}) * Transform::scale({s, s, s});
    const Shape shapes[] = {
        transformed(box_mesh({0.3f, 0.2f, 0.1f}, {1, 1, 1}), t),
        transformed(sphere_mesh({0.3f, 0.2f, 0.1f}, 1, 12, 16), t),
        Sphere{t * Transform::translate({0.3f, 0.2f, 0.1f}), 1, -1, 1, 2 * pi, false},
        Sphere{t * Transform::scale({1, 2, 0.5f}), 1, -1, 1, 2 * pi, false}};
    for (const Shape& shape : shapes)
      for (const Scene& scene : both_ways(shape, placement(s)))
        EXPECT_EQ(self_hits(scene, s, true), 0) << "shape " << &shape - shapes;
  }
}

TEST(SelfIntersection, NeverHappensOnFlatShapesOnEitherSide) {
  for (const float s : scales) {
    SCOPED_TRACE(s);
    const Transform upright = Transform::scale({s, s, s});
    const Transform tilted = Transform::rotate(35, {1, 2, 3}) * upright;
    for (const Transform& t : {upright, tilted}) {
      const std::vector<Vec3> corners{t.point({-1, -1, 0}), t.point({1, -1, 0}),
                                      t.point({-1, 1, 0}), t.point({1, 1, 0})};
      const Shape shapes[] = {TriangleMesh(corners, {{0, 1, 3}, {0, 3, 2}}, {}, {}, false),
                              Disk{t, 0, 1, 0, 2 * pi, false},
                              Disk{t, 0.25f, 1, 0, 2 * pi, false},
                              BilinearMesh(corners, {{0, 1, 2, 3}}, {}, {}, false)};
      for (const Shape& shape : shapes)
        for (const Scene& scene : both_ways(shape, placement(s)))
          for (const bool outward : {false, true})
            EXPECT_EQ(self_hits(scene, s, outward), 0) << "shape " << &shape - shapes;
    }
  }
}

// The point where a camera's central ray meets a huge floor through the origin is zero in
// all coordinates: there is no last place to step by.
TEST(SelfIntersection, NeverHappensAtTheOrigin) {
  const Transform tilted =
      Transform::rotate(35, {1, 2, 3}) * Transform::scale({1e6f, 1e6f, 1});
  const std::vector<Vec3> corners{tilted.point({-1, -1, 0}), tilted.point({1, -1, 0}),
                                  tilted.point({-1, 1, 0}), tilted.point({1, 1, 0})};
  const Shape shapes[] = {TriangleMesh(corners, {{0, 1, 3}, {0, 3, 2}}, {}, {}, false),
                          Disk{tilted, 0, 1, 0, 2 * pi, false},
                          BilinearMesh(corners, {{0, 1, 2, 3}}, {}, {}, false)};
  RandomStream random(8);
  for (const Shape& shape : shapes)
    for (const Scene& scene : both_ways(shape, Transform::rotate(20, {3, 1, 1}))) {
      const Intersector intersector(scene.groups, scene.instances);
      for (int i = 0; i < 4000; ++i) {
        const Vec3 o = random_direction(random) * 4;
        const auto hit = intersector.intersect({o, normalize(-o)}, infinity, RayMask::all);
        if (!hit) continue;  // edge-on
        for (const float cosine : cosines)
          for (const Vec3 n : {hit->point.ng, -hit->point.ng}) {
            const Vec3 d = at_cosine(n, cosine, random);
            const Ray ray{offset_origin(hit->point.p, hit->point.ng, d), d};
            EXPECT_FALSE(intersector.intersect(ray, infinity, RayMask::all))
                << "shape " << &shape - shapes;
            EXPECT_FALSE(intersector.is_occluded(ray, infinity, RayMask::all));
          }
      }
    }
}

#ifdef __SSE2__
// As Embree advises its users to set it for all of their program.
class DenormalsAsZero {
 public:
  DenormalsAsZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
  ~DenormalsAsZero() { _mm_setcsr(before_); }
  DenormalsAsZero(const DenormalsAsZero&) = delete;
  DenormalsAsZero& operator=(const DenormalsAsZero&) = delete;

 private:
  unsigned before_;
};

// Behind a hit at distance zero it goes on at the next number, which must not be zero
// again.
TEST(SelfIntersection, EndsWhereDenormalNumbersAreZero) {
  const Shape floor = TriangleMesh({{-3, 0, -3}, {3, 0, -3}, {3, 0, 3}, {-3, 0, 3}},
                                   {{0, 1, 2}, {0, 2, 3}}, {}, {}, false);
  const std::vector<Intersector::Group> groups{{{&floor, false}}};
  const Intersector intersector(groups, {});
  const DenormalsAsZero mode;
  RandomStream random(9);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 p{4 * random.next_1d() - 2, 0, 4 * random.next_1d() - 2};
    const Vec3 d = at_cosine({0, 1, 0}, random.next_1d(), random);
    EXPECT_FALSE(
        intersector.intersect({offset_origin(p, {0, 1, 0}, d), d}, infinity, RayMask::all));
  }
}
#endif

struct Leaks {
  int rays = 0, through_edges = 0, through_vertices = 0;
};

/// Rays from inside to every vertex and along every edge of a closed mesh.
Leaks find_leaks(const TriangleMesh& mesh, const Intersector& intersector, Vec3 inside) {
  RandomStream random(4);
  Leaks leaks;
  const auto gets_out = [&](Vec3 target) {
    const Ray ray{inside, normalize(target - inside)};
    const bool is_hit = intersector.intersect(ray, infinity, RayMask::all).has_value();
    EXPECT_EQ(is_hit, intersector.is_occluded(ray, infinity, RayMask::all));
    return is_hit ? 0 : 1;
  };
  for (const Vec3i& t : mesh.triangles()) {
    const Vec3 a = mesh.positions()[static_cast<size_t>(t.x)];
    const Vec3 b = mesh.positions()[static_cast<size_t>(t.y)];
    ++leaks.rays;
    leaks.through_vertices += gets_out(a);
    leaks.through_edges += gets_out(lerp(a, b, random.next_1d()));
  }
  return leaks;
}

// Embree evaluates an edge alike for both its triangles, but not the edges around a vertex:
// rays that aim at one by chance are as rare as hits of a point, those that aim on purpose
// are tested here.
TEST(Watertight, RaysDoNotLeakThroughEdges) {
  for (const float s : scales) {
    SCOPED_TRACE(s);
    const Transform t = Transform::rotate(35, {1, 2, 3}) * Transform::scale({s, s, s});
    const TriangleMesh mesh = transformed(sphere_mesh({0.3f, 0.2f, 0.1f}, 1, 24, 40), t);
    const Shape shape = mesh;
    const std::vector<Intersector::Group> groups{{{&shape, false}}};
    const Intersector intersector(groups, {});
    RandomStream random(9);
    for (int i = 0; i < 20; ++i) {
      const Vec3 inside = t.point(Vec3{0.3f, 0.2f, 0.1f} + random_in_cube(random) * 0.5f);
      const Leaks leaks = find_leaks(mesh, intersector, inside);
      EXPECT_EQ(leaks.through_edges, 0);
      EXPECT_LT(leaks.through_vertices, leaks.rays / 100);
    }
  }
}

/// Lets a ray bounce about in a closed shape; returns how often it gets out.
int escapes(const Scene& scene, Vec3 start) {
  const Intersector intersector(scene.groups, scene.instances);
  RandomStream random(12);
  Ray ray{start, random_direction(random)};
  int found = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto hit = intersector.intersect(ray, infinity, RayMask::all);
    if (!hit) {
      ++found;
      ray.o = start;
      continue;
    }
    const Vec3 n = dot(hit->point.ng, ray.d) < 0 ? hit->point.ng : -hit->point.ng;
    ray.d = random_direction(random);
    if (dot(ray.d, n) < 0) ray.d = -ray.d;
    ray.o = offset_origin(hit->point.p, hit->point.ng, ray.d);
  }
  return found;
}

TEST(Watertight, PathsStayInsideClosedShapes) {
  for (const float s : scales) {
    SCOPED_TRACE(s);
    const Transform t = Transform::rotate(35, {1, 2, 3}) * Transform::scale({s, s, s});
    const Vec3 center{0.3f, 0.2f, 0.1f};
    const Shape shapes[] = {
        transformed(box_mesh(center, {1, 0.5f, 2}), t),
        transformed(sphere_mesh(center, 1, 24, 40), t),
        Sphere{t * Transform::translate(center), 1, -1, 1, 2 * pi, false}};
    for (const Shape& shape : shapes) {
      const std::vector<Scene> scenes = both_ways(shape, placement(s));
      EXPECT_EQ(escapes(scenes[0], t.point(center)), 0) << &shape - shapes;
      EXPECT_EQ(escapes(scenes[1], placement(s).point(t.point(center))), 0)
          << &shape - shapes;
    }
  }
}

/// Rays to visible points of a shape, those that the shape itself hides, and those that it
/// would hide if rounding were ignored.
struct Hidden {
  int rays = 0, hidden = 0, hidden_if_flush = 0;
};

Hidden look_at(const Shape& shape, Vec3 center) {
  const Intersector intersector({{{{&shape, false}}}}, {});
  RandomStream random(5);
  Hidden count;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 n = random_direction(random);
    const Vec3 p = center + random_direction(random) * 4;
    const auto sample = sample_direction(shape, p, random.next_2d());
    if (!sample) continue;
    const Vec3 end = sample->point.p;
    const float distance = length(end - p);
    const Vec3 d = (end - p) / distance;
    if (dot(sample->point.ng, d) > 0) continue;  // its back
    const Ray ray{offset_origin(p, n, d), d};
    const float t = distance * (1 - 1e-4f);
    ++count.rays;
    count.hidden += intersector.is_occluded(ray, t - rounded_end(p, end, sample->point.ng),
                                            RayMask::all);
    count.hidden_if_flush += intersector.is_occluded(ray, t, RayMask::all);
  }
  return count;
}

TEST(RoundedEnd, LetsNoShapeHideItself) {
  for (const float away : {0.0f, 1e2f, 1e4f, 1e5f}) {
    SCOPED_TRACE(away);
    const Vec3 center{away, -away, away};
    const Transform t = Transform::translate(center);
    const Shape shapes[] = {Sphere{t, 1, -1, 1, 2 * pi, false},
                            Disk{t, 0, 1, 0, 2 * pi, false},
                            transformed(sphere_mesh({0, 0, 0}, 1, 12, 16), t)};
    for (const Shape& shape : shapes) {
      const Hidden count = look_at(shape, center);
      EXPECT_GT(count.rays, 1000);
      EXPECT_EQ(count.hidden, 0) << "shape " << &shape - shapes;
      EXPECT_GE(count.hidden_if_flush, away == 1e5f ? count.rays / 3 : 0);
    }
  }
}

// Where numbers are fine, an end is hardly shorter.
TEST(RoundedEnd, IsShort) {
  EXPECT_LT(rounded_end({0, 0, 4}, {0, 0, 0}, {0, 0, 1}), 3e-6f);
  EXPECT_LT(rounded_end({1e4f, 0, 4}, {1e4f, 0, 0}, {0, 0, 1}), 3e-6f);
  EXPECT_NEAR(rounded_end({0, 0, 1e4f}, {0, 0, 1e4f + 4}, {0, 0, 1}), 6e-3f, 1e-3f);
  EXPECT_EQ(rounded_end({4, 0, 0}, {0, 0, 0}, {0, 0, 1}), 4);
}

}  // namespace
}  // namespace tyndall
