// SPDX-License-Identifier: Apache-2.0
// Forced collisions: distances by the proxy of a leg, and lights that no leg is near to.
#include <gtest/gtest.h>

#include "scenes.h"
#include "support/chi_square.h"
#include "support/quadrature.h"
#include "support/statistical_tests.h"
#include "tyndall/integrators/collision_distance.h"
#include "tyndall/integrators/leg_proxy.h"
#include "tyndall/techniques/binned_distance.h"

namespace tyndall {
namespace {

using test::estimate;

// Two nested balls of radius 2 and 1; the ray enters at t = 3 and leaves at t = 7.
const Ray through{{0, 0, -5}, {0, 0, 1}};

SceneDescription nested_balls() {
  SceneDescription d;
  d.camera = test::camera(through.o, {0, 0, 0});
  d.media.push_back(test::grey_fog(0.1f, 0.1f));
  d.media.push_back(test::grey_fog(0.9f, 0));
  d.surfaces.push_back(test::boundary_sphere(2, {}, 0, no_medium));
  d.surfaces.push_back(test::boundary_sphere(1, {}, 1, 0));
  return d;
}

TEST(LegProxy, SamplesCollisions) {
  const Scene scene(nested_balls());
  Leg leg(scene, through, nullptr);
  const LegProxy proxy(leg);
  const double share = 1 - std::exp(-(2 * 0.2 + 2 * 0.9));
  EXPECT_NEAR(double{proxy.collision_share()}, share, 1e-6);
  const ChiSquareResult result = chi_square_line(
      [&](float u) -> std::optional<float> {
        return proxy.sample(u, proxy.collision_share())->t;
      },
      [&](double t) { return proxy.collision_pdf_t(static_cast<float>(t)) / share; }, 2, 8);
  EXPECT_GT(result.p_value, sidak(0.01, 6)) << result;
  EXPECT_NEAR(result.mass, 1, 1e-3);
  EXPECT_EQ(result.samples_of_zero_pdf, 0);
}

TEST(LegProxy, CollisionsHaveTheMeanDistanceOfTheMedia) {
  const Scene scene(nested_balls());
  Leg leg(scene, through, nullptr);
  const LegProxy proxy(leg);
  const auto density = [](double t) {
    const double depth = t < 4   ? 0.2 * (t - 3)
                         : t < 6 ? 0.2 + 0.9 * (t - 4)
                                 : 2.0 + 0.2 * (t - 6);
    return (t < 4 || t > 6 ? 0.2 : 0.9) * std::exp(-depth);
  };
  double mass = 0, moment = 0;
  for (const double start : {3.0, 4.0, 6.0}) {
    const double end = start == 4 ? 6 : start + 1;
    mass += quadrature(density, start, end);
    moment += quadrature([&](double t) { return t * density(t); }, start, end);
  }
  double mean = 0;
  constexpr int n = 1 << 14;
  for (int i = 0; i < n; ++i) {
    const auto s =
        proxy.sample((static_cast<float>(i) + 0.5f) / n, proxy.collision_share());
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->pdf_t, proxy.collision_pdf_t(s->t) / proxy.collision_share(),
                1e-4f * s->pdf_t);
    mean += double{s->t} / n;
  }
  EXPECT_NEAR(mean, moment / mass, 1e-4);
}

// What densities are chosen by, and the technique that they are chosen for.
TEST(CollisionDistance, IsBinnedByWhatIsForeseen) {
  const Scene scene(nested_balls());
  Leg leg(scene, through, nullptr);
  const LegProxy proxy(leg);
  const CollisionDistance collision(proxy, far_distance);
  const std::array<float, 64> taps = collision.taps<64>();
  for (int i = 0; i < 64; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / 64;
    EXPECT_NEAR(taps[static_cast<size_t>(i)], collision.sample(u)->t, 4e-4f);
    EXPECT_NEAR(collision.invert(collision.sample(u)->t), u, 1e-5f);
  }
  auto weights = DistanceWeights<32>::ones();
  for (size_t i = 0; i < 20; ++i) weights.values[i] = i % 3 == 0 ? 0.0f : 0.2f;
  const BinnedDistance<CollisionDistance, 32> binned(collision, weights, 0.05f);
  const ChiSquareResult result = chi_square_line(
      [&](float u) -> std::optional<float> { return binned.sample(u)->t; },
      [&](double t) { return double{binned.pdf_t(static_cast<float>(t))}; }, 2, 8);
  EXPECT_GT(result.p_value, sidak(0.01, 6)) << result;
  EXPECT_NEAR(result.mass, 1, 1e-3);
  EXPECT_EQ(result.samples_of_zero_pdf, 0);
}

TEST(LegProxy, HasNoCollisionsInEmptySpace) {
  SceneDescription d;
  d.camera = test::camera(through.o, {0, 0, 0});
  const Scene scene(std::move(d));
  Leg leg(scene, through, nullptr);
  const LegProxy proxy(leg);
  EXPECT_EQ(proxy.collision_share(), 0);
  EXPECT_FALSE(proxy.sample(0.5f, proxy.collision_share()));
  EXPECT_FALSE(LegProxy().sample(0.5f, 0));
}

class ForcedCollisionTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, ForcedCollisionTest,
                         testing::ValuesIn(integrator_names()));

// Sunlight from the side, scattered once in a ball of fog: a closed integral.
TEST_P(ForcedCollisionTest, FindsTheSunInThinFog) {
  constexpr double sigma_s = 0.12, sigma_t = 0.2, g = 0.5, irradiance = 3;
  SceneDescription d;
  d.camera = test::camera(through.o, {0, 0, 0});
  d.media.push_back(test::grey_fog(0.12f, 0.08f, 0.5f));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.lights.push_back(Light(DistantLight{normalize(Vec3{1, 0, 0}), Rgb(3)}));
  // Without a light that is near, there are no connections at all.
  d.lights.push_back(Light(PointLight{{0.5f, 0, 0}, Rgb(1e-6f)}));
  const Scene scene(std::move(d));
  const double phase = (1 - g * g) / (4 * 3.14159265358979) / std::pow(1 + g * g, 1.5);
  const double expected =
      sigma_s * phase * irradiance *
      quadrature(
          [&](double z) {
            return std::exp(-sigma_t * (z + 1 + std::sqrt(std::max(1 - z * z, 0.0))));
          },
          -1, 1);
  const RunningMoments found = estimate(scene, test::settings(GetParam(), 1), 100'000,
                                        [](Sampler&) { return through; });
  EXPECT_LT(found.standard_error(), 0.02 * expected);
  EXPECT_GT(z_p_value(found, expected), 1e-4)
      << found.mean() << " +- " << found.standard_error() << ", expected " << expected;
  // A third of the walks collide; all forced collisions do.
  if (GetParam() != "volpath") {
    EXPECT_LT(found.variance(), 0.2 * expected * expected);
  }
}

// A sky, the sun and a lamp near the ray: each is left to one kind of connection, and walks
// hit the sky.
TEST_P(ForcedCollisionTest, AgreesWithPathTracing) {
  SceneDescription d;
  d.camera = test::camera(through.o, {0, 0, 0});
  d.media.push_back(test::grey_fog(0.5f, 0.05f, 0.6f));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.lights.push_back(Light(DistantLight{normalize(Vec3{1, 2, 0}), Rgb(3)}));
  d.lights.push_back(Light(ConstantEnvironment{Rgb(0.3f)}));
  d.lights.push_back(Light(PointLight{{0.6f, 0, 0}, Rgb(0.5f)}));
  const Scene scene(std::move(d));
  const auto measure = [&](const std::string& integrator) {
    return estimate(scene, test::settings(integrator, 4), 40'000,
                    [](Sampler&) { return through; });
  };
  const RunningMoments tested = measure(GetParam()), plain = measure("volpath");
  EXPECT_LT(tested.standard_error(), 0.02 * tested.mean());
  EXPECT_GT(welch_p_value(tested, plain), 1e-4)
      << tested.mean() << " +- " << tested.standard_error() << ", volpath " << plain.mean()
      << " +- " << plain.standard_error();
}

}  // namespace
}  // namespace tyndall
