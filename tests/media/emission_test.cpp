// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "media/random_media.h"
#include "tyndall/media/blackbody.h"
#include "tyndall/media/cloud_density.h"
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

// Pictures of clouds stay what they are.
TEST(CloudTest, KeepsItsShape) {
  const Vec3 high{-3.2f, 0.8f, 7.7f}, low{0.1f, 0.45f, 0.5f};
  EXPECT_FLOAT_EQ(cloud_density({}, high), 0.0351287313f);
  EXPECT_FLOAT_EQ(cloud_density({}, low), 0.101183787f);
  EXPECT_FLOAT_EQ(cloud_density({.wispiness = 0}, high), 0.0132068535f);
}

// The noise of a row goes on where the last point was.
TEST(CloudTest, GridHoldsTheFunction) {
  const CloudParameters parameters;
  const Bounds3 bounds{{-0.02f, 0.4f, 0.3f}, {0.03f, 0.45f, 0.35f}};
  const PlacedGrid cloud = make_cloud(parameters, bounds);
  for (int i = 0; i < 23; ++i) {
    const auto at = static_cast<float>(i);
    const Vec3 center = bounds.min + bounds.diagonal() * ((at + 0.5f) / 23);
    const Vec3 p = cloud.medium_from_grid.inverse().point(center);
    EXPECT_NEAR(cloud.grid->interpolate(p), cloud_density(parameters, center), 2e-4f) << i;
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
