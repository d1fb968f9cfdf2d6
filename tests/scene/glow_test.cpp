// SPDX-License-Identifier: Apache-2.0
// Sampling of glowing volumes.
#include "tyndall/scene/glow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "media/random_media.h"
#include "support/statistical_tests.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

PlacedGrid constant(float value) {
  return place_in_box({{4, 4, 4}, std::vector<float>(64, value)}, {{0, 0, 0}, {1, 1, 1}});
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
  EmissionDistribution distribution_ = *measure_emission(Medium(medium_), {});
};

INSTANTIATE_TEST_SUITE_P(All, EmissionDistributionTest,
                         testing::Values(Placement::identity, Placement::sheared,
                                         Placement::mirrored, Placement::tiny));

// 1 / pdf integrates to the volume of the box, f / pdf to the power, and each point's
// density is what it was drawn with.
TEST_P(EmissionDistributionTest, SamplesIntegrateWithTheirPdf) {
  const Bounds3 box = medium_.placement().box();
  const Vec3 size = box.diagonal();
  const Transform& map = medium_.placement().world_from_grid();
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
  const Bounds3 box = medium_.placement().box();
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 u{rng_.next_1d(), rng_.next_1d(), rng_.next_1d()};
    const Vec3 p =
        medium_.placement().world_from_grid().point(box.min + box.diagonal() * u);
    if (medium_.at(p).sigma_a.r == 0) continue;
    EXPECT_GT(distribution_.pdf_volume(p), 0);
  }
}

// Directions drawn at a point have the moments that their density says, in each octant of
// the sphere and on the whole; the density is not smooth, so that moments are tested rather
// than cells.
TEST_P(EmissionDistributionTest, DirectionsFollowTheirPdf) {
  const Bounds3 box = medium_.placement().box();
  const VolumeLight light({distribution_});
  for (const Vec3 at : {Vec3{0.45f, 0.6f, 0.3f}, Vec3{1.2f, -0.3f, 0.5f}}) {
    const Vec3 p =
        medium_.placement().world_from_grid().point(box.min + box.diagonal() * at);
    constexpr size_t functions = 12;
    RunningMoments drawn[functions], expected[functions];
    const auto add = [](RunningMoments* moments, Vec3 w, double weight) {
      const int octant = (w.x > 0 ? 1 : 0) + (w.y > 0 ? 2 : 0) + (w.z > 0 ? 4 : 0);
      for (int i = 0; i < 8; ++i) moments[i].add(i == octant ? weight : 0);
      for (int i = 0; i < 3; ++i) moments[8 + i].add(weight * double{w[i]});
      moments[11].add(weight);
    };
    for (int i = 0; i < 100'000; ++i) {
      const auto s = light.sample(p, rng_.next_2d());
      ASSERT_TRUE(s);
      ASSERT_NEAR(s->pdf, light.pdf(p, s->w), 1e-5f * s->pdf);
      add(drawn, s->w, 1);
      const Vec3 w = sample_uniform_sphere(rng_.next_2d());
      add(expected, w, double{light.pdf(p, w)} * 4 * 3.14159265358979);
    }
    for (size_t i = 0; i < functions; ++i)
      EXPECT_GT(welch_p_value(drawn[i], expected[i]), sidak(0.01, 96))
          << i << ": " << drawn[i].mean() << " and " << expected[i].mean();
  }
}

TEST(GlowingMediaTest, DarkMediaHaveNone) {
  const GridMedium dark(constant(1), Transform(), {Rgb(1), Rgb(0), Rgb(0)},
                        IsotropicPhase{});
  const GridMedium cold(constant(1), Transform(), {Rgb(1), Rgb(0), Rgb(1)},
                        IsotropicPhase{}, {.scale = {}, .temperature = constant(50)});
  EXPECT_FALSE(measure_emission(Medium(dark), {}));
  EXPECT_FALSE(measure_emission(Medium(cold), {}));
}

// Two volumes of unequal power: points by power, directions by power and closeness.
TEST(VolumeLightTest, ChoosesAmongVolumes) {
  const auto part = [](Vec3 at, float Le) {
    const GridMedium medium(constant(1), Transform::translate(at),
                            {Rgb(1), Rgb(0), Rgb(Le)}, IsotropicPhase{});
    return *measure_emission(Medium(medium), {});
  };
  const VolumeLight light({part({-6, 0, 0}, 1), part({5, 0, 0}, 3)});
  RandomStream rng(5);
  int in_second = 0, towards_second = 0;
  constexpr int n = 20'000;
  const Vec3 p{-2.5f, 0.5f, 0.5f};
  double inverse = 0;
  for (int i = 0; i < n; ++i) {
    in_second += light.sample_point(rng.next_2d()).x > 0 ? 1 : 0;
    const auto s = light.sample(p, rng.next_2d());
    ASSERT_TRUE(s);
    towards_second += s->w.x > 0 ? 1 : 0;
    inverse += 1 / double{s->pdf} / n;
  }
  EXPECT_NEAR(in_second, 0.75 * n, 5 * std::sqrt(0.25 * 0.75 * n));
  // Centers at distances 3 and 8.
  const double share = 3.0 / 64 / (3.0 / 64 + 1.0 / 9);
  EXPECT_NEAR(towards_second, share * n, 5 * std::sqrt(share * (1 - share) * n));
  EXPECT_LT(inverse, 4 * 3.1416);  // the solid angle of what can be drawn
}

// Homogeneous media lie within their surfaces; without such, they are no light.
TEST(VolumeLightTest, HomogeneousMediaAreCutToTheirSurfaces) {
  SceneDescription d;
  d.media.push_back(Medium(HomogeneousMedium({Rgb(1), Rgb(0), Rgb(2)}, IsotropicPhase{})));
  EXPECT_FALSE(make_volume_light(d));
  d.surfaces.push_back(
      {.shape = Sphere{.world_from_sphere = Transform::translate({1, 2, 3}),
                       .radius = 0.5f,
                       .z_min = -0.5f,
                       .z_max = 0.5f,
                       .phi_max = 2 * pi,
                       .flip_normals = false},
       .material = InterfaceBsdf{},
       .media = {.inside = 0, .outside = no_medium, .is_stated = true},
       .emission = std::nullopt,
       .name = "sphere"});
  const std::optional<VolumeLight> light = make_volume_light(d);
  ASSERT_TRUE(light);
  EXPECT_NEAR(light->bounds().min.x, 0.5f, 1e-6f);
  EXPECT_NEAR(light->bounds().max.z, 3.5f, 1e-6f);
  EXPECT_NEAR(light->power().r, 4 * 3.14159f * 2, 1e-3f);
}

}  // namespace
}  // namespace tyndall
