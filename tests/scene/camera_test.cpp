// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/camera.h"

#include <gtest/gtest.h>

#include "support/statistical_tests.h"
#include "tyndall/sampling/random.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

// A camera somewhere, of a screen window off its axis; `stretch` acts in camera space.
PerspectiveCamera camera(float lens_radius, Vec3 stretch) {
  PerspectiveCamera::Settings s;
  s.world_from_camera = Transform::look_at({1, 2, 3}, {-1, 0.5f, 1}, {0, 1, 0})->inverse() *
                        Transform::scale(stretch);
  s.fov = 50;
  s.screen_min_x = -1.5f;
  s.screen_max_x = 0.5f;
  s.screen_max_y = 0.75f;
  s.lens_radius = lens_radius;
  s.focal_distance = 4;
  return {s, {30, 20}};
}

class CameraTest : public testing::TestWithParam<std::tuple<float, Vec3>> {
 protected:
  PerspectiveCamera camera_ =
      camera(std::get<float>(GetParam()), std::get<Vec3>(GetParam()));
  RandomStream random_{7};
};

INSTANTIATE_TEST_SUITE_P(Lenses, CameraTest,
                         testing::Combine(testing::Values(0.0f, 0.3f),
                                          testing::Values(Vec3{1, 1, 1}, Vec3{-2, 2, 2},
                                                          Vec3{1, 2, 0.5f})));

TEST_P(CameraTest, ViewInvertsRay) {
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u = random_.next_2d(), u_lens = random_.next_2d();
    const Vec2 p_film{30 * u.x, 20 * u.y};
    const Ray ray = camera_.ray(p_film, u_lens);
    const float distance = 0.1f + 10 * random_.next_1d();
    const std::optional<CameraView> view = camera_.view(ray.at(distance), u_lens);
    ASSERT_TRUE(view);
    EXPECT_NEAR(view->p_film.x, p_film.x, 2e-3f);
    EXPECT_NEAR(view->p_film.y, p_film.y, 2e-3f);
    EXPECT_NEAR(view->distance, distance, 1e-5f * (1 + distance));
    EXPECT_LT(length(view->ray.o - ray.o), 1e-6f);
    EXPECT_LT(length(view->ray.d - ray.d), 1e-4f);
    EXPECT_FALSE(camera_.view(ray.at(-distance), u_lens));
  }
}

// All that the picture's pixels fill, in even directions from one point of the lens.
TEST_P(CameraTest, PixelsPerSolidAngleAddUp) {
  const Vec2 u_lens{0.2f, 0.7f};
  const Vec3 lens = camera_.ray({0, 0}, u_lens).o;
  RunningMoments all, left;
  for (int i = 0; i < 400'000; ++i) {
    const Vec3 w = sample_uniform_sphere(random_.next_2d());
    const std::optional<CameraView> view = camera_.view(lens + w, u_lens);
    double pixels = 0;
    if (view && view->p_film.x >= 0 && view->p_film.x < 30 && view->p_film.y >= 0 &&
        view->p_film.y < 20)
      pixels = double{camera_.pixels_per_solid_angle(w) / uniform_sphere_pdf()};
    all.add(pixels);
    left.add(view && view->p_film.x < 10 ? pixels : 0);
  }
  EXPECT_GT(z_p_value(all, 600), sidak(0.01, 12));
  EXPECT_GT(z_p_value(left, 200), sidak(0.01, 12));
  EXPECT_LT(all.standard_error(), 0.02 * 600);
}

}  // namespace
}  // namespace tyndall
