// SPDX-License-Identifier: Apache-2.0
// Media that are nested, overlap and touch, as a ray meets them.
#include <gtest/gtest.h>

#include <cmath>

#include "support/surfaces.h"
#include "tyndall/sampling/random.h"
#include "tyndall/sampling/warps.h"
#include "tyndall/scene/boundary_check.h"
#include "tyndall/scene/scene.h"

namespace tyndall {
namespace {

using test::box_boundary;
using test::sphere_boundary;

// A medium that is known by its scattering coefficient, a power of two.
Medium numbered(int i) {
  return Medium(
      HomogeneousMedium({Rgb(0), Rgb(std::ldexp(1.0f, i)), Rgb(0)}, IsotropicPhase{}));
}

float sigma_s(const Medium* medium) { return medium ? medium->at({}).sigma_s.r : 0; }

SceneDescription scene_of(int media, std::vector<Surface> surfaces,
                          Vec3 eye = {0, 0, -10}) {
  SceneDescription d;
  d.camera = test::camera_at(eye);
  for (int i = 0; i < media; ++i) d.media.push_back(numbered(i));
  d.surfaces = std::move(surfaces);
  return d;
}

struct Stretch {
  float t_min, t_max, sigma_s;
};

void expect_along(const Scene& scene, const Ray& ray, std::vector<Stretch> expected) {
  MediumSpans spans;
  scene.media_along(ray, 100, nullptr, spans);
  ASSERT_EQ(spans.size(), expected.size());
  for (size_t i = 0; i < spans.size(); ++i) {
    EXPECT_NEAR(spans[i].t_min, expected[i].t_min, 1e-4f) << i;
    EXPECT_NEAR(spans[i].t_max, expected[i].t_max, 1e-4f) << i;
    EXPECT_EQ(sigma_s(spans[i].medium), expected[i].sigma_s) << i;
  }
}

const Ray along_z{{0.1f, 0.2f, -10}, {0, 0, 1}};

TEST(OverlapTest, NestedBoundariesThatNameTheirExterior) {
  const Scene scene(scene_of(2, {box_boundary({-3, -3, -3}, {3, 3, 3}, 0, no_medium),
                                 box_boundary({-1, -1, -1}, {1, 1, 1}, 1, 0)}));
  expect_along(scene, along_z,
               {{0, 7, 0}, {7, 9, 1}, {9, 11, 2}, {11, 13, 1}, {13, 100, 0}});
}

TEST(OverlapTest, BoundariesThatNameNoneOverlap) {
  const Scene scene(scene_of(2, {box_boundary({-3, -3, -3}, {3, 3, 1}, 0, no_medium),
                                 box_boundary({-1, -1, -1}, {1, 1, 4}, 1, no_medium)}));
  expect_along(scene, along_z,
               {{0, 7, 0}, {7, 9, 1}, {9, 11, 3}, {11, 14, 2}, {14, 100, 0}});
}

TEST(OverlapTest, CoplanarFacesOfTwoBoxes) {
  for (const bool swapped : {false, true}) {
    Surface first = box_boundary({-1, -1, -1}, {1, 1, 0.3f}, 0, no_medium);
    Surface second = box_boundary({-1, -1, 0.3f}, {1, 1, 2}, 1, no_medium);
    if (swapped) std::swap(first, second);
    const Scene scene(scene_of(2, {first, second}));
    expect_along(scene, along_z, {{0, 9, 0}, {9, 10.3f, 1}, {10.3f, 12, 2}, {12, 100, 0}});
    expect_along(scene, {{0.1f, 0.2f, 10}, {0, 0, -1}},
                 {{0, 8, 0}, {8, 9.7f, 2}, {9.7f, 11, 1}, {11, 100, 0}});
  }
}

// The inner box shares five faces with the outer one, and both name what is around them.
TEST(OverlapTest, NestedBoxesThatShareFaces) {
  for (const bool swapped : {false, true}) {
    Surface outer = box_boundary({-1, -1, -1}, {1, 1, 1}, 0, no_medium);
    Surface inner = box_boundary({-1, -1, -1}, {1, 1, 0}, 1, 0);
    if (swapped) std::swap(outer, inner);
    const Scene scene(scene_of(2, {outer, inner}));
    expect_along(scene, along_z, {{0, 9, 0}, {9, 10, 2}, {10, 11, 1}, {11, 100, 0}});
    expect_along(scene, {{0.1f, 0.2f, 10}, {0, 0, -1}},
                 {{0, 9, 0}, {9, 10, 1}, {10, 11, 2}, {11, 100, 0}});
  }
}

// The wall is hit, and lies in the medium of the box that ends on it.
TEST(OverlapTest, BoxExactlyOnAWall) {
  for (const bool swapped : {false, true}) {
    Surface box = box_boundary({-1, -1, -1}, {1, 1, 0.7f}, 0, no_medium);
    Surface wall = box_boundary({-2, -2, 0.7f}, {2, 2, 3}, no_medium, no_medium);
    wall.material = DiffuseBsdf{Rgb(0.5f)};
    wall.media.is_stated = false;
    if (swapped) std::swap(box, wall);
    const Scene scene(scene_of(1, {box, wall}));
    RandomStream rng(1);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 o{rng.next_1d() - 0.5f, rng.next_1d() - 0.5f, -rng.next_1d()};
      const Vec3 target{rng.next_1d() - 0.5f, rng.next_1d() - 0.5f, 0.7f};
      const Medium* medium = &scene.description().media[0];
      MediumSpans spans;
      const Ray ray{o, normalize(target - o)};
      const auto hit = scene.trace(ray, 100, medium, spans);
      ASSERT_TRUE(hit);
      EXPECT_NEAR(ray.at(hit->hit.t).z, 0.7f, 1e-5f);
      EXPECT_EQ(sigma_s(medium), 1);
      EXPECT_EQ(spans.size(), 1u);
    }
  }
}

// Rays exactly through edges, diagonals and corners of a mesh cross it once.
TEST(OverlapTest, RaysThroughEdgesAndCorners) {
  const Scene scene(scene_of(1, {box_boundary({-1, -1, -1}, {1, 1, 1}, 0, no_medium)}));
  for (const Vec3 through : {Vec3{0, 0, -1}, Vec3{0.5f, 0.5f, -1}, Vec3{-0.5f, 0.5f, -1}})
    expect_along(scene, {{through.x, through.y, -10}, {0, 0, 1}},
                 {{0, 9, 0}, {9, 11, 1}, {11, 100, 0}});
  MediumSpans spans;
  for (const Vec3 corner : {Vec3{1, 1, 1}, Vec3{-1, 1, -1}, Vec3{1, 0.5f, 1}}) {
    scene.media_along({corner * 5.0f, normalize(corner * -1.0f)}, 100, nullptr, spans);
    EXPECT_EQ(spans.back().medium, nullptr);
  }
}

TEST(OverlapTest, OneMediumEnteredTwiceCountsOnce) {
  const Scene scene(scene_of(1, {box_boundary({-3, -3, -3}, {3, 3, 1}, 0, no_medium),
                                 box_boundary({-1, -1, -1}, {1, 1, 4}, 0, no_medium)}));
  MediumSpans spans;
  scene.media_along(along_z, 100, nullptr, spans);
  for (const MediumSpan& span : spans) {
    const bool is_inside = span.t_min > 6.9f && span.t_max < 14.1f;
    EXPECT_EQ(sigma_s(span.medium), is_inside ? 1 : 0);
  }
}

// Random spheres that name no exterior: every stretch has the media of the spheres around
// it.
TEST(OverlapTest, RandomSpheres) {
  RandomStream rng(7);
  constexpr int count = 9;
  std::vector<Surface> surfaces;
  Vec3 centers[count];
  float radii[count];
  for (int i = 0; i < count; ++i) {
    centers[i] = {rng.next_1d() - 0.5f, rng.next_1d() - 0.5f, rng.next_1d() - 0.5f};
    radii[i] = 0.2f + rng.next_1d();
    surfaces.push_back(sphere_boundary(centers[i], radii[i], i, no_medium));
  }
  const Scene scene(scene_of(count, surfaces));
  int overlapping = 0;
  for (int ray_index = 0; ray_index < 2000; ++ray_index) {
    const Vec3 w = sample_uniform_sphere(rng.next_2d());
    const Vec3 near{rng.next_1d() - 0.5f, rng.next_1d() - 0.5f, rng.next_1d() - 0.5f};
    const Ray ray{near - w * 5.0f, w};
    MediumSpans spans;
    scene.media_along(ray, 20, nullptr, spans);
    for (const MediumSpan& span : spans) {
      const Vec3 p = ray.at(0.5f * (span.t_min + span.t_max));
      if (span.t_max - span.t_min < 1e-4f) continue;
      float expected = 0;
      for (int i = 0; i < count; ++i)
        if (distance_squared(p, centers[i]) < sqr(radii[i]))
          expected += std::ldexp(1.0f, i);
      ASSERT_EQ(sigma_s(span.medium), expected);
      overlapping += std::log2(expected) != std::floor(std::log2(expected)) ? 1 : 0;
    }
  }
  EXPECT_GT(overlapping, 2000);
}

TEST(OverlapTest, CameraInsideTwo) {
  const std::vector<Surface> surfaces{sphere_boundary({0, 0, 0}, 2, 0, no_medium),
                                      sphere_boundary({0, 0, 1}, 2, 1, no_medium),
                                      sphere_boundary({0, 0, 9}, 1, 2, no_medium)};
  const struct {
    Vec3 eye;
    std::vector<int> media;
    float sigma_s;
  } cases[] = {{{0, 0, 0.5f}, {0, 1}, 3},
               {{0, 0, -1.5f}, {0}, 1},
               {{0, 0, 2.5f}, {1}, 2},
               {{0, 0, 5}, {}, 0}};
  for (const auto& c : cases) {
    const Scene scene(scene_of(3, surfaces, c.eye));
    EXPECT_EQ(scene.camera_media(), c.media);
    EXPECT_EQ(sigma_s(scene.camera_medium()), c.sigma_s);
    EXPECT_TRUE(scene.remarks().empty());
  }
}

// What a floor without a medium of its own hides tells nothing, for or against.
TEST(OverlapTest, PlainSurfacesDoNotVoteAboutTheCamera) {
  const Surface floor{
      .shape = Disk{Transform::translate({0, -0.5f, 0}) * Transform::rotate(90, {1, 0, 0}),
                    0, 4, 0, 2 * pi, false},
      .material = DiffuseBsdf(Rgb(0.5f)),
      .media = {},
      .emission = {},
      .name = {}};
  const Scene in_fog(
      scene_of(1, {sphere_boundary({0, 0, 0}, 5, 0, no_medium), floor}, {0, 0, 0}));
  EXPECT_EQ(in_fog.camera_media(), std::vector<int>{0});
  EXPECT_TRUE(in_fog.remarks().empty());
  // In two media, of which downward only the boundary of one is in front of the floor.
  const Scene in_both(
      scene_of(2,
               {sphere_boundary({0, 0, 0}, 5, 0, no_medium),
                box_boundary({-9, -0.4f, -9}, {9, 9, 9}, 1, no_medium), floor},
               {0, 0, 0}));
  EXPECT_EQ(in_both.camera_media(), (std::vector<int>{0, 1}));
  EXPECT_TRUE(in_both.remarks().empty());
  // Fog without an end that the scene states, and a cloud in front of the camera.
  SceneDescription endless =
      scene_of(2, {sphere_boundary({0, 0, 3}, 2.5f, 1, no_medium), floor}, {0, 0, 0});
  endless.camera_medium = 0;
  const Scene scene(std::move(endless));
  EXPECT_EQ(scene.camera_media(), std::vector<int>{0});
  EXPECT_TRUE(scene.remarks().empty());
}

// Statements are believed only where boundaries do not know better.
TEST(OverlapTest, BoundariesDenyTheStatedMediumOfTheCamera) {
  SceneDescription outside =
      scene_of(1,
               {box_boundary({-9, -9, 1}, {9, 9, 9}, 0, no_medium),
                box_boundary({-9, -9, -9}, {9, 9, -1}, 0, no_medium),
                box_boundary({-9, 1, -1}, {9, 9, 1}, 0, no_medium),
                box_boundary({-9, -9, -1}, {9, -1, 1}, 0, no_medium)},
               {0, 0, 0});
  outside.camera_medium = 0;
  EXPECT_EQ(Scene(std::move(outside)).camera_media(), std::vector<int>{});
}

// Half of the directions say one, half the other: it is where it looks.
TEST(OverlapTest, CameraOnABoundaryLooksIntoAMedium) {
  for (const float side : {-1.0f, 1.0f}) {
    const Scene scene(
        scene_of(1, {box_boundary({-1, -1, -1}, {1, 1, 1}, 0, no_medium)}, {0, 0, side}));
    const std::vector<int> inside{0}, outside{};
    EXPECT_EQ(scene.camera_media(), side < 0 ? inside : outside);
  }
}

TEST(BoundaryCheckTest, NamesWhatIsOpenOrInsideOut) {
  const Surface whole = box_boundary({-1, -1, -1}, {1, 1, 1}, 0, no_medium);
  EXPECT_TRUE(check_boundaries(std::vector{whole}).empty());

  Surface open = whole;
  const auto& mesh = std::get<TriangleMesh>(whole.shape);
  std::vector<Vec3i> fewer(mesh.triangles().begin() + 2, mesh.triangles().end());
  open.shape = TriangleMesh(mesh.positions(), fewer, {}, {}, false);
  open.name = "trianglemesh at a.pbrt:3:1";
  EXPECT_EQ(check_boundaries(std::vector{open}),
            std::vector<std::string>{
                "trianglemesh at a.pbrt:3:1: this boundary between media is open (4 edges "
                "have a face on one side only): light that passes the gap takes the medium "
                "along"});

  Surface turned = whole;
  turned.shape = TriangleMesh(mesh.positions(), mesh.triangles(), {}, {}, true);
  turned.name = "trianglemesh at a.pbrt:5:1";
  EXPECT_EQ(check_boundaries(std::vector{turned}),
            std::vector<std::string>{
                "trianglemesh at a.pbrt:5:1: this boundary is inside out: its medium fills "
                "all but what it encloses; ReverseOrientation turns it"});

  // The rest closes it.
  Surface rest = whole;
  rest.shape =
      TriangleMesh(mesh.positions(),
                   {mesh.triangles().begin(), mesh.triangles().begin() + 2}, {}, {}, false);
  EXPECT_TRUE(check_boundaries(std::vector{open, rest}).empty());
  // Spheres, too.
  Surface ball = sphere_boundary({1, 2, 3}, 2, 0, no_medium);
  ball.name = "sphere at a.pbrt:7:1";
  EXPECT_TRUE(check_boundaries(std::vector{ball}).empty());
  std::get<Sphere>(ball.shape).flip_normals = true;
  EXPECT_EQ(check_boundaries(std::vector{ball}),
            std::vector<std::string>{
                "sphere at a.pbrt:7:1: this boundary is inside out: its medium fills all "
                "but what it encloses; ReverseOrientation turns it"});
  EXPECT_TRUE(check_boundaries(std::vector{whole, ball}).size() == 1);
  Surface around = sphere_boundary({1, 2, 3}, 3, 0, no_medium);  // of a hollow ball
  EXPECT_TRUE(check_boundaries(std::vector{around, ball}).empty());
  Surface bowl = sphere_boundary({1, 2, 3}, 2, 0, no_medium);
  std::get<Sphere>(bowl.shape).z_max = 0;
  bowl.name = "sphere at a.pbrt:9:1";
  EXPECT_EQ(
      check_boundaries(std::vector{bowl}),
      std::vector<std::string>{
          "sphere at a.pbrt:9:1: this boundary between media is open (it is a disk or "
          "a clipped sphere): light that passes the gap takes the medium along"});
  EXPECT_TRUE(check_boundaries(std::vector{bowl, bowl}).empty());  // who knows
  // A hole in a medium that is all around.
  Surface hole = turned;
  hole.media = {.inside = no_medium, .outside = 0, .is_stated = true};
  EXPECT_TRUE(check_boundaries(std::vector{hole}).empty());
}

}  // namespace
}  // namespace tyndall
