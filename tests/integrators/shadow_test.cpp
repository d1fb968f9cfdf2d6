// SPDX-License-Identifier: Apache-2.0
// What is close to a lamp hides it, however far away it is looked at from.
#include <gtest/gtest.h>

#include "scenes.h"

namespace tyndall {
namespace {

class ShadowTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, ShadowTest, testing::ValuesIn(integrator_names()));

Surface diffuse_sphere(float radius) {
  Surface sphere = test::boundary_sphere(radius, {}, no_medium, no_medium);
  sphere.material = DiffuseBsdf{Rgb(0.5f)};
  return sphere;
}

// The mean radiance of the walls of a large room, around a lamp in a closed housing.
double look(const std::string& integrator, float housing) {
  SceneDescription d;
  const Vec3 eye{0, 0, -250};
  d.camera = test::camera(eye, {0, 0, 0});
  d.surfaces.push_back(diffuse_sphere(300));
  if (housing > 0) d.surfaces.push_back(diffuse_sphere(housing));
  d.lights.push_back(Light(PointLight{{}, Rgb(1e5f)}));
  const Scene scene(std::move(d));
  return test::estimate(scene, test::settings(integrator, 2), 4'000,
                        [&](Sampler& sampler) {
                          return Ray{eye, normalize(Vec3{sampler.next_1d() + 0.1f,
                                                         sampler.next_1d() + 0.1f, 1})};
                        })
      .mean();
}

TEST_P(ShadowTest, SmallHousingsOfFarLampsAreTight) {
  const double open = look(GetParam(), 0), closed = look(GetParam(), 0.02f);
  EXPECT_GT(open, 0.1);
  // Rays to a lit point that grazes the housing end where rounding may put its other side.
  if (GetParam() == "learned")
    EXPECT_LT(closed, 0.01 * open);
  else
    EXPECT_EQ(closed, 0);
}

}  // namespace
}  // namespace tyndall
