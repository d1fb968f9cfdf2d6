// SPDX-License-Identifier: Apache-2.0
// Legs along which the distance to a lamp hardly varies: they leave single scattering to
// next event estimation, but not the direction in which light is scattered twice.
#include <gtest/gtest.h>

#include "scenes.h"
#include "support/statistical_tests.h"
#include "tyndall/integrators/connection_leg.h"

namespace tyndall {
namespace {

constexpr float end = 0.3f;
const Ray short_ray{{0, 0, 0}, {0, 0, 1}};

// The ray ends at a black plate, in the same fog as a lamp that is seven times as far.
SceneDescription steady_fog() {
  SceneDescription d;
  d.camera = test::camera(short_ray.o, {0, 0, 1});
  d.camera_medium = 0;
  d.media.push_back(test::grey_fog(0.5f, 0));
  d.surfaces.push_back(test::diffuse_disk(end, 0.1f, 0));
  d.lights.push_back(Light(PointLight{{0, 2, 0.15f}, Rgb(10)}));
  return d;
}

TEST(SteadyLegTest, IsLeftByDualConnectionsOnly) {
  const Scene scene(steady_fog());
  const ConnectionContext context(scene, {.single = true, .dual = true});
  const Pivots pivots(scene, 1);
  Leg leg(scene, short_ray, scene.camera_medium());
  ConnectionLeg connection(context, pivots, leg);
  EXPECT_FALSE(connection.single(0));
  EXPECT_FALSE(connection.reaches_single(0, 0.1f));
  ASSERT_TRUE(connection.dual(0));
  LegStart x;
  x.t = 0.1f;
  x.is_in_medium = true;
  EXPECT_TRUE(connection.reaches_dual(x, 0));
  x.t = 2 * end;
  EXPECT_FALSE(connection.reaches_dual(x, 0));
}

// Walks turn to the lamp's neighbourhood by chance, and single connections then find the
// more the nearer they pass.
TEST(SteadyLegTest, FindsLightThatIsScatteredTwiceWithoutFireflies) {
  const Scene scene(steady_fog());
  const auto measure = [&](const std::string& integrator, int count) {
    return test::estimate(scene, test::settings(integrator, 2, {.min = 2, .max = 2}), count,
                          [](Sampler&) { return short_ray; });
  };
  const RunningMoments single = measure("equiangular", 400'000);
  for (const char* name : {"jis", "learned"}) {
    const RunningMoments dual = measure(name, 20'000);
    EXPECT_LT(dual.standard_error(), 0.01 * dual.mean());
    EXPECT_GT(welch_p_value(dual, single), 1e-3)
        << name << ": " << dual.mean() << " +- " << dual.standard_error() << " vs "
        << single.mean() << " +- " << single.standard_error();
    EXPECT_LT(dual.variance(), 0.05 * single.variance())
        << name << " " << dual.variance() / single.variance();
  }
}

}  // namespace
}  // namespace tyndall
