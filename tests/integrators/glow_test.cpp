// SPDX-License-Identifier: Apache-2.0
// Glowing volumes, found by the walk and by next event estimation.
#include <gtest/gtest.h>

#include "scenes.h"
#include "support/statistical_tests.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

class GlowingTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, GlowingTest, testing::ValuesIn(integrator_names()));

Medium hot(float sigma_a, float sigma_s, float Le) {
  return Medium(HomogeneousMedium({Rgb(sigma_a), Rgb(sigma_s), Rgb(Le)}, IsotropicPhase{}));
}

// Through a sphere that absorbs and glows: Le (1 - exp(-sigma_a * chord)).
TEST_P(GlowingTest, AbsorbingSphereHasItsClosedForm) {
  for (const float sigma_a : {0.1f, 3.0f}) {
    SceneDescription d;
    d.camera = test::camera({0, 0, -3}, {0, 0, 0});
    d.media.push_back(hot(sigma_a, 0, 2));
    d.surfaces.push_back(test::boundary_sphere(1));
    const Scene scene(std::move(d));
    const float height = 0.6f;
    const RunningMoments moments =
        test::estimate(scene, test::settings(GetParam(), 8), 100, [&](Sampler&) {
          return Ray{{0, height, -3}, {0, 0, 1}};
        });
    const double expected = -2 * std::expm1(-double{sigma_a} * 1.6);
    EXPECT_NEAR(moments.mean(), expected, 1e-5 * expected);
  }
}

// The mean radiance that a small hot ball sends to a point of thin fog, or of a wall, has a
// closed form where it neither absorbs nor is dimmed: 4 pi sigma_a Le volume over the
// squared distance.
TEST_P(GlowingTest, ThinBallLightsAWall) {
  const float sigma_a = 1e-4f, radius = 0.1f;
  SceneDescription d;
  d.camera = test::camera({0, 0, -1}, {0, 0, 1});
  d.media.push_back(hot(sigma_a, 0, 1 / sigma_a));
  d.surfaces.push_back(test::boundary_sphere(radius));
  d.surfaces.push_back(test::diffuse_disk(2, 50, 0.5f));
  const Scene scene(std::move(d));
  const RunningMoments moments =
      test::estimate(scene, test::settings(GetParam(), 1), 30'000, [&](Sampler&) {
        return Ray{{3, 0, -1}, {0, 0, 1}};
      });
  const double pi_ = 3.14159265358979, distance2 = 4 + 9;
  const double volume = 4 * pi_ / 3 * 1e-3;
  const double irradiance = volume / distance2 * (2 / std::sqrt(distance2));
  const double expected = 0.5 / pi_ * irradiance;
  EXPECT_LT(moments.standard_error(), 0.01 * expected);
  // The ball is small, not a point: its second moment over the squared distance.
  EXPECT_NEAR(moments.mean(), expected, 4 * moments.standard_error() + 3e-3 * expected);
}

// A small hot ball in a dark room with fog and a wall.
SceneDescription dark_room(Medium ball) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -1}, {0, 0, 1});
  d.camera_medium = 1;
  d.media.push_back(std::move(ball));
  d.media.push_back(test::grey_fog(0.2f, 0.05f, 0.5f));
  d.surfaces.push_back(test::boundary_sphere(0.3f, {0.5f, 0.8f, 1}, 0, 1));
  d.surfaces.push_back(test::diffuse_disk(2, 3, 0.8f));
  return d;
}

RunningMoments look(SceneDescription d, const std::string& integrator, uint64_t seed,
                    int count) {
  const Scene scene(std::move(d));
  RenderSettings s = test::settings(integrator, 4);
  s.seed = seed;
  return test::estimate(scene, s, count, [](Sampler& sampler) {
    const Vec2 u = sampler.next_2d();
    return Ray{{0, 0, -1}, normalize(Vec3{u.x - 0.5f, u.y - 0.8f, 2})};
  });
}

// With the sphere inside out the medium has no bounds to be sampled in: only the walk finds
// it.
TEST_P(GlowingTest, NextEventEstimationFindsTheSameLightWithLessVariance) {
  SceneDescription sampled = dark_room(hot(2, 1, 30));
  SceneDescription walked = sampled;
  Surface& sphere = walked.surfaces[0];
  std::get<Sphere>(sphere.shape).flip_normals = true;
  std::swap(sphere.media.inside, sphere.media.outside);
  const RunningMoments with = look(std::move(sampled), GetParam(), 1, 30'000);
  const RunningMoments without = look(std::move(walked), "volpath", 2, 200'000);
  EXPECT_LT(without.standard_error(), 0.03 * without.mean());
  EXPECT_GT(welch_p_value(with, without), sidak(0.01, 8))
      << with.mean() << " +- " << with.standard_error() << " and " << without.mean()
      << " +- " << without.standard_error();
  EXPECT_LT(with.variance(), 0.2 * without.variance());
}

// A grid of constant density glows as the homogeneous medium does.
TEST_P(GlowingTest, GridGlowsLikeTheHomogeneousMedium) {
  constexpr int n = 12;
  const DensityGrid ones{{n, n, n}, std::vector<float>(n * n * n, 1.0f)};
  const Transform turned = Transform::translate({0.5f, 0.8f, 1}) *
                           Transform::rotate(40, {1, 2, 3}) *
                           Transform::scale({1, -0.8f, 1.2f});
  const Medium grid(GridMedium(ones, {{-0.6f, -0.6f, -0.6f}, {0.6f, 0.6f, 0.6f}}, turned,
                               {Rgb(2), Rgb(1), Rgb(30)}, IsotropicPhase{}));
  const RunningMoments a = look(dark_room(grid), GetParam(), 3, 30'000);
  const RunningMoments b = look(dark_room(hot(2, 1, 30)), GetParam(), 4, 30'000);
  EXPECT_LT(a.standard_error(), 0.03 * a.mean());
  EXPECT_GT(welch_p_value(a, b), sidak(0.01, 8)) << a.mean() << " and " << b.mean();
}

}  // namespace
}  // namespace tyndall
