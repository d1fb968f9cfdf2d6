// SPDX-License-Identifier: Apache-2.0
// Overlapping media are one medium with the sum of their coefficients and the mixture of
// their phase functions.
#include <gtest/gtest.h>

#include "scenes.h"
#include "support/statistical_tests.h"

namespace tyndall {
namespace {

class OverlapTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, OverlapTest, testing::ValuesIn(integrator_names()));

Medium coloured(Rgb sigma_a, Rgb sigma_s, PhaseFunction phase) {
  return Medium(HomogeneousMedium({sigma_a, sigma_s, Rgb(0)}, std::move(phase)));
}

// Beer and Lambert, by the lengths in each and in both.
TEST_P(OverlapTest, AbsorbersMultiplyTheirTransmittance) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -5}, {0, 0, 0});
  d.media.push_back(test::grey_fog(0, 0.4f));
  d.media.push_back(test::grey_fog(0, 1.1f));
  d.surfaces.push_back(test::boundary_sphere(1, {0, 0, 0}, 0));
  d.surfaces.push_back(test::boundary_sphere(1, {0, 0, 1.2f}, 1));
  d.lights.push_back(Light(ConstantEnvironment{Rgb(1)}));
  const Scene scene(std::move(d));
  const RunningMoments moments =
      test::estimate(scene, test::settings(GetParam(), 8), 50'000, [](Sampler&) {
        return Ray{{0, 0, -5}, {0, 0, 1}};
      });
  EXPECT_GT(z_p_value(moments, std::exp(-0.4 * 2 - 1.1 * 2)), 1e-3) << moments.mean();
  EXPECT_LT(moments.standard_error(), 0.03 * moments.mean());
}

// A ball within a ball, either overlapping it or nested in it with everything summed up.
SceneDescription two_balls(Medium outer, Medium inner, int around_inner) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -3}, {0, 0, 0});
  d.media.push_back(std::move(outer));
  d.media.push_back(std::move(inner));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.surfaces.push_back(test::boundary_sphere(0.6f, {0.2f, 0, 0}, 1, around_inner));
  d.lights.push_back(Light(PointLight{{0.5f, 0.9f, -1.5f}, Rgb(5)}));
  d.lights.push_back(Light(ConstantEnvironment{Rgb(0.2f)}));
  return d;
}

RunningMoments look(SceneDescription d, const std::string& integrator, uint64_t seed,
                    Vec3 eye) {
  d.camera = test::camera(eye, {0, 0, 10});
  const Scene scene(std::move(d));
  RenderSettings s = test::settings(integrator, 6);
  s.seed = seed;
  return test::estimate(scene, s, 20'000, [&](Sampler& sampler) {
    return Ray{eye, normalize(Vec3{0.6f * sampler.next_1d() - 0.2f, 0.1f, 2.5f})};
  });
}

// From outside and from inside both; the inner medium once homogeneous, once a grid.
TEST_P(OverlapTest, EqualsOneMediumOfTheSum) {
  const Rgb a_outer(0.1f), s_outer{0.8f, 1, 0.3f}, a_inner{0.3f, 0.1f, 0},
      s_inner{1.6f, 0.5f, 0};
  const HenyeyGreenstein forward(0.6f), backward(-0.3f);
  const Medium outer = coloured(a_outer, s_outer, forward);
  // The red channel, which is looked at, scatters by this mixture.
  const float share = s_outer.r / (s_outer.r + s_inner.r);
  const Medium both = coloured(a_outer + a_inner, s_outer + s_inner,
                               TwoLobePhase(forward, backward, share));
  constexpr int n = 12;
  const DensityGrid ones{{n, n, n}, std::vector<float>(n * n * n, 1.0f)};
  const Medium homogeneous = coloured(a_inner, s_inner, backward);
  const Medium grid(GridMedium(ones, {{-1, -1, -1}, {1, 1, 1}}, Transform(),
                               {a_inner, s_inner, Rgb(0)}, backward));
  for (const Vec3 eye : {Vec3{0, 0, -3}, Vec3{0.1f, 0, -0.2f}}) {
    const RunningMoments expected = look(two_balls(outer, both, 0), GetParam(), 1, eye);
    for (const Medium& inner : {homogeneous, grid}) {
      const RunningMoments moments =
          look(two_balls(outer, inner, no_medium), GetParam(), 2, eye);
      EXPECT_LT(moments.standard_error(), 0.1 * moments.mean());
      EXPECT_GT(welch_p_value(moments, expected), sidak(0.01, 16))
          << moments.mean() << " +- " << moments.standard_error() << " and "
          << expected.mean() << " +- " << expected.standard_error();
    }
  }
}

// Neither albedo one nor overlap shows in a furnace.
TEST_P(OverlapTest, WhiteFurnace) {
  SceneDescription d = two_balls(coloured(Rgb(0), {3, 1, 0}, HenyeyGreenstein(0.7f)),
                                 coloured(Rgb(0), {0, 1, 2}, RayleighPhase()), no_medium);
  d.lights = {Light(ConstantEnvironment{Rgb(1)})};
  const Vec3 eye{0, 0, -3};
  const Scene scene(std::move(d));
  const RunningMoments moments =
      test::estimate(scene, test::settings(GetParam(), 100'000), 5000, [&](Sampler& s) {
        return Ray{eye, normalize(Vec3{0.6f * s.next_1d() - 0.3f, 0.1f, 2.5f})};
      });
  EXPECT_GT(z_p_value(moments, 1), sidak(0.01, 4)) << moments.mean();
  EXPECT_LT(moments.standard_error(), 0.03);
}

}  // namespace
}  // namespace tyndall
