// SPDX-License-Identifier: Apache-2.0
// Media whose channels differ by much, up to one that is not there at all.
#include <gtest/gtest.h>

#include "scenes.h"
#include "support/statistical_tests.h"

namespace tyndall {
namespace {

class ChromaticTest : public testing::TestWithParam<std::tuple<std::string, Rgb, bool>> {};
INSTANTIATE_TEST_SUITE_P(All, ChromaticTest,
                         testing::Combine(testing::Values("volpath", "learned"),
                                          testing::Values(Rgb{12, 1, 0}, Rgb{0, 0.5f, 6},
                                                          Rgb{20, 20, 0.01f}),
                                          testing::Bool()));

Medium white(Rgb sigma_s, bool is_grid) {
  const MediumProperties properties{Rgb(0), sigma_s, Rgb(0)};
  if (!is_grid) return Medium(HomogeneousMedium(properties, HenyeyGreenstein(0.6f)));
  // From half to all of the density, from sample to sample.
  constexpr int n = 8;
  DensityGrid grid{{n, n, n}, {}};
  for (int i = 0; i < n * n * n; ++i) grid.values.push_back(i * 7 % 5 < 2 ? 0.5f : 1);
  return Medium(GridMedium(grid, {{-2, -2, -2}, {2, 2, 2}}, Transform(), properties,
                           HenyeyGreenstein(0.6f)));
}

// In a furnace all channels are one. A walk is weighted by the mean of the densities with
// which the three channels would have made it, so that none gains more than threefold by
// the choice of channel; by one channel's density alone, weights would be without bound.
TEST_P(ChromaticTest, NoSampleIsAFirefly) {
  const auto& [integrator, sigma_s, is_grid] = GetParam();
  SceneDescription d;
  const Vec3 eye{0, 0, -3};
  d.camera = test::camera(eye, {0, 0, 0});
  d.media.push_back(white(sigma_s, is_grid));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.lights.push_back(Light(ConstantEnvironment{Rgb(1)}));
  const Scene scene(std::move(d));
  const RenderSettings s = test::settings(integrator, 100'000);
  const std::unique_ptr<Integrator> tracer = make_integrator(scene, s);
  RunningMoments moments[3];
  Rgb largest;
  uint32_t allowed = 0;
  for (uint32_t i = 0; i < 6000; ++i) {
    if (i >= allowed) allowed = tracer->prepare(i);
    Sampler sampler(s.sampler, s.seed, {0, 0}, i);
    const Vec2 u = sampler.next_2d();
    const Rgb L =
        tracer->Li({eye, normalize(Vec3{0.6f * u.x - 0.3f, 0.6f * u.y - 0.3f, 3})}, sampler)
            .L;
    for (int c = 0; c < 3; ++c) {
      moments[c].add(double{L[c]});
      largest[c] = std::max(largest[c], L[c]);
    }
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(z_p_value(moments[c], 1), sidak(0.01, 36)) << c;
    EXPECT_LT(moments[c].standard_error(), 0.03) << c;
    // Where nothing scatters, nothing adds up.
    if (sigma_s[c] == 0) {
      EXPECT_LE(largest[c], 3.0001f) << c;
    }
  }
}

}  // namespace
}  // namespace tyndall
