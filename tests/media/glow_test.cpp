// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/glow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "media/random_media.h"
#include "support/statistical_tests.h"

namespace tyndall {
namespace {

const Bounds3 box{{0, 0, 0}, {1, 2, 1}};

struct Thickness {
  float sigma;
  Placement placement;
};

class GlowTest : public testing::TestWithParam<Thickness> {};
INSTANTIATE_TEST_SUITE_P(All, GlowTest,
                         testing::Values(Thickness{0.01f, Placement::identity},
                                         Thickness{2, Placement::sheared},
                                         Thickness{100, Placement::mirrored}));

// Against quadrature of the integral of transmittance times emission, coloured, with one
// channel that neither absorbs nor glows, and the transmittance that goes on.
TEST_P(GlowTest, IntegratesEmissionAndTransmittance) {
  RandomStream rng(hash(1, GetParam().placement));
  const DensityGrid grid = random_grid(rng, {9, 17, 8}, GridContent::uniform_noise);
  const Transform world_from_medium = random_transform(rng, GetParam().placement);
  const float sigma = GetParam().sigma / length(world_from_medium.vector({1, 0, 0}));
  const MediumProperties properties{{sigma, 0.2f * sigma, 0}, {0, sigma, 0}, {3, 1, 1}};
  const Medium medium(
      GridMedium(grid, box, world_from_medium, properties, IsotropicPhase{}));
  for (int i = 0; i < 4; ++i) {
    const Ray ray = random_ray(rng, RayStart::inside, box, world_from_medium);
    const float t_max = 3 * length(world_from_medium.bounds(box).diagonal());
    RunningMoments L[3], T[3];
    for (int k = 0; k < 20'000; ++k) {
      Rgb transmittance(1);
      const Rgb glow = estimate_glow(medium, ray, t_max, rng, transmittance);
      for (int c = 0; c < 3; ++c)
        L[c].add(double{glow[c]}), T[c].add(double{transmittance[c]});
    }
    const double depth =
        reference_optical_depth(grid, box, world_from_medium, ray, double{t_max});
    for (int c = 0; c < 2; ++c) {
      const double sigma_t = double{properties.sigma_t()[c]};
      const double through = std::exp(-sigma_t * depth);
      // Emission in proportion to extinction integrates in closed form.
      const double expected = double{properties.sigma_a[c] * properties.Le[c]} / sigma_t *
                              -std::expm1(-sigma_t * depth);
      EXPECT_GT(z_p_value(L[c], expected), sidak(0.01, 48))
          << L[c].mean() << " +- " << L[c].standard_error() << " not " << expected;
      EXPECT_GT(through > 1e-4 ? z_p_value(T[c], through) : 1, sidak(0.01, 48))
          << T[c].mean() << " +- " << T[c].standard_error() << " not " << through;
      EXPECT_LT(L[c].standard_error(), 0.02 * expected);
    }
    EXPECT_EQ(L[2].mean(), 0);
    EXPECT_EQ(T[2].mean(), 1);
  }
}

TEST(GlowTest, IsExactInHomogeneousMedia) {
  RandomStream rng(2);
  const Medium medium(
      HomogeneousMedium({{2, 0, 1}, {1, 0, 0}, {5, 7, 2}}, IsotropicPhase{}));
  Rgb T(0.5f);
  const Rgb L = estimate_glow(medium, {{0, 0, 0}, {0, 0, 1}}, 0.25f, rng, T);
  EXPECT_NEAR(L.r, 0.5f * 10 / 3 * (1 - std::exp(-0.75f)), 1e-6f);
  EXPECT_EQ(L.g, 0);
  EXPECT_NEAR(L.b, 0.5f * 2 * (1 - std::exp(-0.25f)), 1e-6f);
  EXPECT_NEAR(T.r, 0.5f * std::exp(-0.75f), 1e-6f);
  EXPECT_EQ(T.g, 0.5f);
  Rgb far(1);
  EXPECT_FLOAT_EQ(estimate_glow(medium, {{0, 0, 0}, {0, 0, 1}}, infinity, rng, far).b, 2);
  EXPECT_EQ(far, Rgb(0, 1, 0));
}

}  // namespace
}  // namespace tyndall
