// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "support/chi_square.h"
#include "tyndall/lights/light.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// Faces down, towards -z.
Shape lamp_disk(float radius) {
  return Disk{Transform::translate({0, 0, 2}), 0, radius, 0, 2 * pi, true};
}

Shape lamp_sphere(float radius) {
  return Sphere{Transform::translate({0, 0, 2}), radius, -radius, radius, 2 * pi, false};
}

// Irradiance per radiance on a surface at `p` that faces `n`, by drawing directions.
RunningMoments irradiance(const Light& light, Vec3 p, Vec3 n, int samples) {
  RandomStream random(1);
  RunningMoments m;
  for (int i = 0; i < samples; ++i) {
    const auto s = light.sample(p, random.next_2d());
    m.add(s ? double{s->L.g / s->pdf * std::max(dot(n, s->wi), 0.0f)} : 0);
  }
  return m;
}

// The same by drawing points on the light.
RunningMoments irradiance_from_points(const Light& light, Vec3 p, Vec3 n, int samples) {
  RandomStream random(2);
  RunningMoments m;
  for (int i = 0; i < samples; ++i) {
    const auto point = light.sample_point(random.next_2d());
    const Vec3 wi = normalize(point->on.p - p);
    const float geometry = std::max(dot(n, wi), 0.0f) * abs_dot(point->on.ng, wi) /
                           distance_squared(point->on.p, p);
    m.add(double{light.emission(point->on, -wi).g * geometry / point->pdf_area});
  }
  return m;
}

TEST(AreaLight, DiskGivesTheIrradianceOfItsClosedForm) {
  const Shape shape = lamp_disk(1.5f);
  const Light light(AreaLight{&shape, Rgb(3), false});
  const double expected = 3 * double{pi} * 2.25 / (2.25 + 4);
  EXPECT_GT(z_p_value(irradiance(light, {}, {0, 0, 1}, 50'000), expected), 0.003);
  EXPECT_GT(z_p_value(irradiance_from_points(light, {}, {0, 0, 1}, 50'000), expected),
            0.003);
}

TEST(AreaLight, SphereGivesTheIrradianceOfItsClosedForm) {
  const Shape shape = lamp_sphere(0.8f);
  const Light light(AreaLight{&shape, Rgb(3), false});
  const double expected = 3 * double{pi} * 0.64 / 4;
  EXPECT_GT(z_p_value(irradiance(light, {}, {0, 0, 1}, 50'000), expected), 0.003);
  EXPECT_GT(z_p_value(irradiance_from_points(light, {}, {0, 0, 1}, 50'000), expected),
            0.003);
}

TEST(AreaLight, TurnsItsBackUnlessTwoSided) {
  const Shape shape = lamp_disk(1);
  const Light one_sided(AreaLight{&shape, Rgb(1), false}),
      two_sided(AreaLight{&shape, Rgb(1), true});
  const Vec3 behind{0, 0, 4};
  EXPECT_FALSE(one_sided.sample(behind, {0.3f, 0.6f}));
  ASSERT_TRUE(two_sided.sample(behind, {0.3f, 0.6f}));
  EXPECT_LT(two_sided.sample(behind, {0.3f, 0.6f})->wi.z, 0);
  EXPECT_FLOAT_EQ(two_sided.power(1).r, 2 * one_sided.power(1).r);
  EXPECT_NEAR(one_sided.power(1).r, pi * pi, 1e-4f);
}

TEST(AreaLight, DirectionsMatchTheirDensity) {
  const Shape shape = lamp_disk(1.5f);
  const Light light(AreaLight{&shape, Rgb(1), false});
  const Vec3 from{1, 0.5f, 0.7f};
  const auto draw = [&](Vec2 u) -> std::optional<Vec3> {
    const auto s = light.sample(from, u);
    if (!s) return std::nullopt;
    EXPECT_FALSE(s->is_delta);
    EXPECT_NEAR((from + s->wi * s->distance).z, 2, 1e-5f);
    return s->wi;
  };
  const auto pdf = [&](Vec3 w) {
    if (!(w.z > 0)) return 0.0;
    SurfacePoint on{};
    on.p = from + w * ((2 - from.z) / w.z);
    on.ng = on.ns = {0, 0, -1};
    return sqr(on.p.x) + sqr(on.p.y) <= sqr(1.5f) * 1.00001f ? double{light.pdf(from, on)}
                                                             : 0.0;
  };
  const ChiSquareResult r = chi_square_sphere(draw, pdf, 100'000);
  EXPECT_GT(r.p_value, 0.003) << r;
  EXPECT_NEAR(r.mass, 1, 3e-4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
}

TEST(AreaLight, IsEmptyRatherThanNotANumber) {
  const Shape point = lamp_sphere(0), dot = lamp_disk(0), disk = lamp_disk(1);
  for (const Shape* shape : {&point, &dot, &disk}) {
    const Light light(AreaLight{shape, Rgb(1), true});
    for (const Vec3 from : {Vec3{0, 0, 2}, Vec3{}, Vec3{0.5f, 0, 2}}) {
      const auto s = light.sample(from, {0.5f, 0.5f});
      if (!s) continue;
      EXPECT_TRUE(is_finite(s->L) && is_finite(s->wi) && s->pdf > 0 &&
                  std::isfinite(s->pdf));
    }
    EXPECT_TRUE(is_finite(light.power(1)));
  }
  EXPECT_FALSE(Light(AreaLight{&dot, Rgb(1), true}).sample({}, {0.5f, 0.5f}));
  EXPECT_FALSE(Light(AreaLight{&dot, Rgb(1), true}).sample_point({0.5f, 0.5f}));
}

TEST(AreaLight, LiesInItsExtent) {
  const Shape shape = lamp_sphere(0.8f);
  const Light light(AreaLight{&shape, Rgb(1), false});
  const auto extent = light.extent();
  ASSERT_TRUE(extent);
  Bounds3 box = extent->box;
  box.extend(box.min - Vec3{1e-5f, 1e-5f, 1e-5f});
  box.extend(box.max + Vec3{1e-5f, 1e-5f, 1e-5f});
  RandomStream random(3);
  for (int i = 0; i < 1000; ++i) {
    const auto point = light.sample_point(random.next_2d());
    EXPECT_TRUE(box.contains(point->on.p));
    EXPECT_FALSE(point->is_delta);
  }
  EXPECT_FALSE(light.is_infinite());
}

}  // namespace
}  // namespace tyndall
