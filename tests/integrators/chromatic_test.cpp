// SPDX-License-Identifier: Apache-2.0
// Media whose channels differ by much, up to one that is not there at all.
#include <gtest/gtest.h>

#include "scenes.h"
#include "support/quadrature.h"
#include "support/statistical_tests.h"
#include "tyndall/math/constants.h"

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
    if (i >= allowed) allowed = tracer->prepare(i, {});
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

class DeepChannelTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, DeepChannelTest,
                         testing::ValuesIn(integrator_names()));

const Vec3 lamp{2, 3, -3};
constexpr float intensity = 20;

// From the centre line of a ball of radius one around the origin, at height z.
double single_scattering(double sigma, double z) {
  const double to_lamp = std::sqrt(4 + 9 + (-3 - z) * (-3 - z));
  const double cosine = z * (-3 - z) / to_lamp;  // times the distance from the centre
  const double way_out = -cosine + std::sqrt(cosine * cosine + 1 - z * z);
  return sigma * std::exp(-sigma * (z + 1 + way_out)) * double{inv_4pi} *
         double{intensity} / (to_lamp * to_lamp);
}

// One channel of the ball lets nothing through, as the mean of the channels does: what the
// others let through must not be lost.
TEST_P(DeepChannelTest, LeavesTheOtherChannelsTheirLight) {
  for (const Rgb sigma : {Rgb{1, 0.1f, 1000}, Rgb{0.1f, 1000, 1}, Rgb{1000, 1, 0.1f}}) {
    SceneDescription d;
    const Vec3 eye{0, 0, -4};
    d.camera = test::camera(eye, {0, 0, 0});
    d.media.push_back(Medium(HomogeneousMedium({Rgb(0), sigma, Rgb(0)}, IsotropicPhase{})));
    d.surfaces.push_back(test::boundary_sphere(1));
    d.lights.push_back(Light(PointLight{lamp, Rgb(intensity)}));
    const Scene scene(std::move(d));
    const RunningMoments found =
        test::estimate(scene, test::settings(GetParam(), 1), 30'000, [&](Sampler&) {
          return Ray{eye, {0, 0, 1}};
        });
    const auto f = [&](double z) { return single_scattering(double{sigma.r}, z); };
    const double truth = quadrature(f, -1, -0.98) + quadrature(f, -0.98, 1);
    EXPECT_GT(z_p_value(found, truth), sidak(0.01, 15))
        << sigma.r << ": " << found.mean() << " +- " << found.standard_error() << " and "
        << truth;
    EXPECT_LT(found.standard_error(), 0.05 * truth);
  }
}

// The same in a room that is filled with it, where light comes by way of the walls, too.
TEST_P(DeepChannelTest, LeavesTheOthersTheLightOfWalls) {
  const auto look = [](const std::string& integrator) {
    SceneDescription d;
    const Vec3 eye{0, 0, -1.9f};
    d.camera = test::camera(eye, {0, 0, 0});
    d.camera_medium = 0;
    const MediumProperties fog{Rgb{0.05f, 0, 0}, Rgb{0.1f, 0.3f, 1000}, Rgb(0)};
    d.media.push_back(Medium(HomogeneousMedium(fog, IsotropicPhase{})));
    Surface wall = test::boundary_box(2, 0, 0);
    wall.material = DiffuseBsdf{Rgb(0.5f)};
    d.surfaces.push_back(wall);
    d.lights.push_back(Light(PointLight{{0.5f, 1, 0}, Rgb(2)}));
    const Scene scene(std::move(d));
    return test::estimate(
        scene, test::settings(integrator, 3), 60'000, [&](Sampler& sampler) {
          return Ray{
              eye, normalize(Vec3{sampler.next_1d() - 0.5f, sampler.next_1d() - 0.5f, 1})};
        });
  };
  const RunningMoments truth = look("volpath"), found = look(GetParam());
  EXPECT_GT(welch_p_value(found, truth), sidak(0.01, 5))
      << found.mean() << " +- " << found.standard_error() << " and " << truth.mean()
      << " +- " << truth.standard_error();
  EXPECT_LT(found.standard_error(), 0.05 * truth.mean());
}

}  // namespace
}  // namespace tyndall
