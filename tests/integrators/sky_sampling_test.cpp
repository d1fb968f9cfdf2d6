// SPDX-License-Identifier: Apache-2.0
// Directions to skies: what is sampled, and that a wrong guide biases nothing.
#include "tyndall/integrators/sky_sampling.h"

#include <gtest/gtest.h>

#include "scenes.h"
#include "support/chi_square.h"
#include "tyndall/integrators/light_visibility.h"

namespace tyndall {
namespace {

Light picture_sky() {
  constexpr int n = 8;
  std::vector<Rgb> pixels;
  for (int i = 0; i < n * n; ++i)
    pixels.push_back(i == 27 ? Rgb(9, 8, 7) : Rgb(0.2f, 0.3f, 0.1f));
  return Light(ImageEnvironment(Transform::rotate(40, {1, 2, 3}), n, pixels, 1));
}

TEST(LightChoiceTest, AtInfinityThereIsNothingFinite) {
  const std::vector<Light> lights{
      Light(PointLight{{0, 0, 0}, Rgb(1000)}), Light(ConstantEnvironment{Rgb(1)}),
      Light(DistantLight{{0, 0, 1}, Rgb(4 * pi)}), picture_sky()};
  const Bounds3 box{{-1, -1, -1}, {1, 1, 1}};
  const LightProbabilities p = LightChoice(lights, box).at_infinity();
  EXPECT_EQ(p.probability(0), 0);
  EXPECT_NEAR(p.probability(1), p.probability(2), 1e-6f);
  EXPECT_GT(p.probability(3), 0);
  EXPECT_NEAR(p.probability(1) + p.probability(2) + p.probability(3), 1, 1e-6f);
  EXPECT_EQ(p.select(lights, 0)->index, 1u);
  EXPECT_EQ(p.select(lights, 0.99999994f)->index, 3u);
  const std::vector<Light> lamps{lights[0]};
  EXPECT_EQ(LightChoice(lamps, box).at_infinity().size(), 0u);
}

// A ball of fog with two wide disks in it: the sky shines in between them.
SceneDescription gap(Light sky) {
  SceneDescription d;
  d.camera = test::camera({0, 0, 0}, {0, 0, 1});
  d.camera_medium = 0;
  d.media.push_back(test::grey_fog(0.3f, 0.05f, 0.3f));
  d.surfaces.push_back(test::boundary_sphere(7));
  d.surfaces.push_back(test::diffuse_disk(1, 6, 0.4f));
  d.surfaces.push_back(test::diffuse_disk(-1, 6, 0.4f));
  d.lights.push_back(std::move(sky));
  return d;
}

RunningMoments radiance(const Scene& scene, const ConnectionSettings& connections,
                        uint64_t seed, int count) {
  return test::estimate(scene, connections, seed, count, {0, 0, 0}, 1);
}

// What is seen where, but of the wrong places, and of the wrong directions.
std::shared_ptr<const LightVisibility> lies() {
  const CellGrid grid({{-6, -6, -1}, {6, 6, 1}}, 64);
  auto guide = std::make_shared<SkyGuide>(grid);
  for (size_t cell = 0; cell < grid.count(); ++cell) {
    SkyGuide::Weights weights{};
    weights[hash(uint64_t{1}, cell) % SkyGuide::strata] = 1;
    guide->set(cell, weights);
  }
  guide->finish();
  return std::make_shared<const LightVisibility>(LightVisibility::Maps{},
                                                 LightVisibility::Skies{{0, guide}});
}

TEST(SkySamplingTest, DirectionsHaveTheirDensity) {
  for (const Light& light : {Light(ConstantEnvironment{Rgb(1)}), picture_sky()}) {
    const Scene scene(gap(light));
    const LightVisibility visibility(scene);
    const SkyGuide* guide = visibility.sky(0);
    ASSERT_TRUE(guide);
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{3, 2, 0.5f}, Vec3{40, 0, 0}}) {
      const ChiSquareResult r = chi_square_sphere(
          [&](Vec2 u) -> std::optional<Vec3> {
            const std::optional<LightSample> s = sample_light(light, guide, p, u);
            if (!s) return std::nullopt;
            EXPECT_EQ(s->pdf, environment_pdf(light, guide, p, s->wi));
            return s->wi;
          },
          [&](Vec3 w) { return double{environment_pdf(light, guide, p, w)}; }, 200'000, 3);
      EXPECT_GT(r.p_value, sidak(0.01, 6)) << r;
      EXPECT_NEAR(r.mass, 1, 2e-3);
      EXPECT_EQ(r.samples_of_zero_pdf, 0);
      EXPECT_EQ(r.missing, 0);
    }
  }
}

TEST(SkySamplingTest, FindsTheSkyAndAWrongGuideIsNoBias) {
  for (const Light& light : {Light(ConstantEnvironment{Rgb(1)}), picture_sky()}) {
    const Scene scene(gap(light));
    const RunningMoments path = radiance(scene, {}, 1, 60'000);
    ConnectionSettings unguided = test::with_visibility({});
    unguided.sky_directions = false;
    const RunningMoments without = radiance(scene, unguided, 2, 60'000);
    const RunningMoments with = radiance(scene, test::with_visibility({}), 3, 60'000);
    const RunningMoments wrong = radiance(scene, test::with_visibility(lies()), 4, 60'000);
    for (const RunningMoments* moments : {&without, &with, &wrong}) {
      EXPECT_LT(moments->standard_error(), 0.05 * moments->mean());
      EXPECT_GT(welch_p_value(path, *moments), 1e-3)
          << path.mean() << " +- " << path.standard_error() << " vs " << moments->mean()
          << " +- " << moments->standard_error();
    }
    EXPECT_LT(with.variance(), 0.8 * without.variance());
    EXPECT_GT(wrong.variance(), with.variance());
  }
}

}  // namespace
}  // namespace tyndall
