// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "media/random_media.h"
#include "support/statistical_tests.h"
#include "tyndall/media/blackbody.h"
#include "tyndall/media/cloud_density.h"
#include "tyndall/media/emission_distribution.h"
#include "tyndall/media/grid_medium.h"

namespace tyndall {
namespace {

// Chromaticities of Planck's locus [CIE15]: x, y at 2856 K (illuminant A) and at 6504 K.
TEST(BlackbodyTest, LiesOnThePlanckianLocus) {
  const auto chromaticity = [](Rgb c) {
    const float x = 0.4124564f * c.r + 0.3575761f * c.g + 0.1804375f * c.b;
    const float y = 0.2126729f * c.r + 0.7151522f * c.g + 0.0721750f * c.b;
    const float z = 0.0193339f * c.r + 0.1191920f * c.g + 0.9503041f * c.b;
    return Vec2{x / (x + y + z), y / (x + y + z)};
  };
  // The fit of the observer is good to two digits and a half.
  EXPECT_NEAR(chromaticity(blackbody_radiance(2856)).x, 0.4476f, 4e-3);
  EXPECT_NEAR(chromaticity(blackbody_radiance(2856)).y, 0.4074f, 4e-3);
  EXPECT_NEAR(chromaticity(blackbody_radiance(6504)).x, 0.3135f, 4e-3);
  EXPECT_NEAR(chromaticity(blackbody_radiance(6504)).y, 0.3237f, 4e-3);
}

TEST(BlackbodyTest, StaysFiniteAndPositive) {
  EXPECT_EQ(blackbody_radiance(-5), Rgb(0));
  EXPECT_EQ(blackbody_radiance(100), Rgb(0));
  EXPECT_EQ(blackbody_radiance(NAN), Rgb(0));
  EXPECT_EQ(blackbody_radiance(1e9f), blackbody_radiance(40000));
  float before = 0;
  for (float kelvin = 500; kelvin < 4000; kelvin *= 1.1f) {
    EXPECT_GT(blackbody_radiance(kelvin).r, before);  // the peak moves into the visible
    before = blackbody_radiance(kelvin).r;
  }
}

PlacedGrid constant(float value) {
  return place_in_box({{4, 4, 4}, std::vector<float>(64, value)}, {{0, 0, 0}, {1, 1, 1}});
}

TEST(GridEmissionTest, ScalesAndHeats) {
  GridEmission emission{.scale = constant(3),
                        .temperature = constant(20),
                        .temperature_offset = 5,
                        .temperature_scale = 200};
  const MediumProperties glowing{Rgb(1), Rgb(2), {1, 0.5f, 0}};
  const Transform world_from_medium = Transform::translate({10, 0, 0});
  const GridMedium medium(constant(0.5f), world_from_medium, glowing, IsotropicPhase{},
                          emission);
  const MediumProperties inside = medium.at({10.5f, 0.5f, 0.5f});
  const Rgb expected = 3 * blackbody_radiance(3000) * glowing.Le;
  EXPECT_TRUE(medium.is_emissive());
  EXPECT_FLOAT_EQ(inside.sigma_a.r, 0.5f);
  EXPECT_FLOAT_EQ(inside.Le.r, expected.r);
  EXPECT_FLOAT_EQ(inside.Le.g, expected.g);
  EXPECT_EQ(inside.Le.b, 0);
  // The same along a ray.
  auto segments = medium.segments({{10.5f, 0.5f, -1}, {0, 0, 1}}, 10);
  MediumSegment s;
  ASSERT_TRUE(segments.next(s));
  while (s.t_max < 1.5f) ASSERT_TRUE(segments.next(s));
  EXPECT_FLOAT_EQ(segments.at(1.5f).Le.r, expected.r);
}

TEST(GridEmissionTest, ColdMediaAreDark) {
  const GridEmission emission{.scale = {}, .temperature = constant(50)};
  const GridMedium medium(constant(1), Transform(), {Rgb(1), Rgb(0), Rgb(1)},
                          IsotropicPhase{}, emission);
  EXPECT_EQ(medium.at({0.5f, 0.5f, 0.5f}).Le, Rgb(0));
}

class EmissionDistributionTest : public testing::TestWithParam<Placement> {
 protected:
  RandomStream rng_{3};
  Transform world_from_medium_ = random_transform(rng_, GetParam());
  GridMedium medium_{random_grid(rng_, {40, 20, 10}, GridContent::mostly_empty),
                     {{-1, 0, 2}, {1, 3, 2.5f}},
                     world_from_medium_,
                     {Rgb(0.5f), Rgb(1), {2, 1, 0}},
                     IsotropicPhase{}};
  EmissionDistribution distribution_ = *EmissionDistribution::make(Medium(medium_));
};

INSTANTIATE_TEST_SUITE_P(All, EmissionDistributionTest,
                         testing::Values(Placement::identity, Placement::sheared,
                                         Placement::mirrored, Placement::tiny));

// 1 / pdf integrates to the volume of the box, f / pdf to the power, and each point's
// density is what it was drawn with.
TEST_P(EmissionDistributionTest, SamplesIntegrateWithTheirPdf) {
  const Bounds3 box = medium_.grid_box();
  const Vec3 size = box.diagonal();
  const Transform& map = medium_.world_from_grid();
  const double volume =
      double{size.x * size.y * size.z} *
      std::abs(double{
          dot(map.vector({1, 0, 0}), cross(map.vector({0, 1, 0}), map.vector({0, 0, 1})))});
  RunningMoments volumes, powers, uniform_powers;
  int disagree = 0;
  for (int i = 0; i < 200'000; ++i) {
    const auto s = distribution_.sample(rng_.next_1d(),
                                        {rng_.next_1d(), rng_.next_1d(), rng_.next_1d()});
    const MediumProperties at = medium_.at(s.p);
    volumes.add(1 / double{s.pdf_volume} / volume);
    powers.add(4 * 3.14159265 * double{at.sigma_a.r * at.Le.r} / double{s.pdf_volume} /
               volume);
    const Vec3 p =
        map.point(box.min + size * Vec3{rng_.next_1d(), rng_.next_1d(), rng_.next_1d()});
    uniform_powers.add(4 * 3.14159265 * double{medium_.at(p).sigma_a.r * 2});
    // Points on the border of a cell may be taken for the neighbour's.
    disagree += std::abs(distribution_.pdf_volume(s.p) / s.pdf_volume - 1) > 1e-3f ? 1 : 0;
  }
  EXPECT_GT(z_p_value(volumes, 1), sidak(0.01, 8)) << volumes.mean();
  EXPECT_GT(welch_p_value(powers, uniform_powers), sidak(0.01, 8));
  EXPECT_LT(disagree, 200);
  EXPECT_LT(powers.variance(), 0.3 * uniform_powers.variance());
  EXPECT_NEAR(double{distribution_.power().r} / volume / uniform_powers.mean(), 1, 0.05);
  EXPECT_EQ(distribution_.power().b, 0);
}

TEST_P(EmissionDistributionTest, IsPositiveWhereverTheMediumGlows) {
  const Bounds3 box = medium_.grid_box();
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 u{rng_.next_1d(), rng_.next_1d(), rng_.next_1d()};
    const Vec3 p = medium_.world_from_grid().point(box.min + box.diagonal() * u);
    if (medium_.at(p).sigma_a.r == 0) continue;
    EXPECT_GT(distribution_.pdf_volume(p), 0);
  }
}

TEST(GlowingMediaTest, DarkMediaHaveNone) {
  const GridMedium dark(constant(1), Transform(), {Rgb(1), Rgb(0), Rgb(0)},
                        IsotropicPhase{});
  const GridMedium cold(constant(1), Transform(), {Rgb(1), Rgb(0), Rgb(1)},
                        IsotropicPhase{}, {.scale = {}, .temperature = constant(50)});
  EXPECT_FALSE(EmissionDistribution::make(Medium(dark)));
  EXPECT_FALSE(EmissionDistribution::make(Medium(cold)));
}

TEST(CloudTest, IsWithinItsBoundsAndDenseBelow) {
  const CloudParameters parameters;
  RandomStream rng(1);
  double low = 0, high = 0;
  for (int i = 0; i < 2000; ++i) {
    const float x = rng.next_1d(), z = rng.next_1d();
    const float below = cloud_density(parameters, {x, -0.1f, z});
    const float above = cloud_density(parameters, {x, 0.9f, z});
    EXPECT_EQ(below, 1);
    EXPECT_GE(above, 0);
    EXPECT_LE(above, 1);
    low += double{below};
    high += double{above};
  }
  EXPECT_GT(high, 10);
  EXPECT_LT(high, 0.3 * low);
  EXPECT_EQ(cloud_density(parameters, {0.3f, 1.01f, 0.2f}), 0);
}

TEST(CloudTest, GridMatchesTheFunction) {
  const CloudParameters parameters{.density = 2, .wispiness = 0, .frequency = 1};
  const Bounds3 bounds{{0, 0, 0}, {2, 1, 1}};
  const PlacedGrid cloud = make_cloud(parameters, bounds);
  RandomStream rng(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{uniform(rng, 0.05f, 1.95f), uniform(rng, 0.05f, 0.95f),
                 uniform(rng, 0.05f, 0.95f)};
    const float found = cloud.grid->interpolate(cloud.medium_from_grid.inverse().point(p));
    EXPECT_NEAR(found, cloud_density(parameters, p), 0.05f);
  }
}

// Noise that is its own derivative's integral: wisps follow its gradient.
TEST(CloudTest, FrequencyShrinksDetail) {
  const auto roughness = [](float frequency) {
    const CloudParameters parameters{.density = 1, .wispiness = 1, .frequency = frequency};
    double sum = 0;
    for (int i = 0; i < 4000; ++i) {
      const float x = 0.01f * static_cast<float>(i);
      sum += std::abs(double{cloud_density(parameters, {x + 0.01f, 0.6f, 0.5f})} -
                      double{cloud_density(parameters, {x, 0.6f, 0.5f})});
    }
    return sum;
  };
  EXPECT_GT(roughness(5), 2 * roughness(0.5f));
}

}  // namespace
}  // namespace tyndall
