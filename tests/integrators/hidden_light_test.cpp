// SPDX-License-Identifier: Apache-2.0
// A light that no ray meets, or only some do, lights as the same light in view.
#include <gtest/gtest.h>

#include "scenes.h"
#include "support/statistical_tests.h"
#include "tyndall/math/constants.h"

namespace tyndall {
namespace {

class HiddenLightTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, HiddenLightTest,
                         testing::ValuesIn(integrator_names()));

// Outside the fog that it shines into, so that no path between two vertices meets it.
const Disk lamp{.world_from_disk = Transform(),
                .height = -1.6f,
                .radius = 0.6f,
                .inner_radius = 0,
                .phi_max = 2 * pi,
                .flip_normals = false};
const AreaEmission emission{Rgb(7)};

// Shines as much in all three.
enum class Lamp { seen, hidden, translucent };
constexpr float alpha = 0.3f;

void add_lamp(SceneDescription& d, Lamp kind) {
  const AreaEmission brighter{emission.L / alpha};
  if (kind == Lamp::hidden) d.hidden_emitters.push_back({lamp, emission});
  if (kind == Lamp::seen)
    d.surfaces.push_back({lamp, DiffuseBsdf{Rgb(0)}, {}, emission, "lamp"});
  if (kind == Lamp::translucent)
    d.surfaces.push_back({lamp, DiffuseBsdf{Rgb(0)}, {}, brighter, "lamp", alpha});
}

RunningMoments look(Lamp kind, const std::string& integrator) {
  SceneDescription d;
  const Vec3 eye{-4, 0, 0};
  d.camera = test::camera(eye, {0, 0, 0});
  d.media.push_back(test::grey_fog(0.8f, 0.1f, 0.5f));
  d.surfaces.push_back(test::boundary_box(1));
  d.surfaces.push_back(test::diffuse_disk(0.8f, 0.5f, 0.7f));
  add_lamp(d, kind);
  const Scene scene(std::move(d));
  RenderSettings s = test::settings(integrator, 20);
  s.seed = static_cast<uint64_t>(kind);
  return test::estimate(scene, s, 100'000, [&](Sampler& sampler) {
    return Ray{eye, normalize(Vec3{4, sampler.next_1d() - 0.5f, sampler.next_1d()})};
  });
}

TEST_P(HiddenLightTest, LightsAsIfItWereInView) {
  const RunningMoments seen = look(Lamp::seen, GetParam());
  for (const Lamp kind : {Lamp::hidden, Lamp::translucent}) {
    const RunningMoments other = look(kind, GetParam());
    EXPECT_LT(other.standard_error(), 0.02 * other.mean());
    EXPECT_GT(welch_p_value(other, seen), sidak(0.01, 10))
        << other.mean() << " +- " << other.standard_error() << " and " << seen.mean()
        << " +- " << seen.standard_error();
  }
}

TEST_P(HiddenLightTest, IsSeenThrough) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -4}, {0, 0, 0});
  add_lamp(d, Lamp::translucent);
  const float sky = 1.5f;
  d.lights.push_back(Light(ConstantEnvironment{Rgb(sky)}));
  const Scene scene(std::move(d));
  const RunningMoments moments =
      test::estimate(scene, test::settings(GetParam(), 5), 20'000, [](Sampler& sampler) {
        return Ray{{0.1f * sampler.next_1d(), 0, 4}, {0, 0, -1}};
      });

  EXPECT_NEAR(moments.mean(), emission.L.r + (1 - alpha) * sky,
              4 * moments.standard_error());
}

TEST_P(HiddenLightTest, IsNotSeenAndCastsNoShadow) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -4}, {0, 0, 0});
  d.hidden_emitters.push_back({lamp, emission});
  d.lights.push_back(Light(ConstantEnvironment{Rgb(0.25f)}));
  const Scene scene(std::move(d));
  const RunningMoments moments =
      test::estimate(scene, test::settings(GetParam(), 5), 10, [](Sampler&) {
        return Ray{{0, 0, -4}, {0, 0, 1}};
      });
  EXPECT_EQ(moments.mean(), 0.25);
}

}  // namespace
}  // namespace tyndall
