// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "support/quadrature.h"
#include "tyndall/lights/light.h"

namespace tyndall {
namespace {

constexpr Vec3 light_position{1, 2, 3};

TEST(PointLight, FallsOffWithTheSquareOfDistance) {
  const Light light(PointLight{light_position, Rgb(1, 2, 4)});
  const auto s = light.sample({1, 2, 1}, {0.3f, 0.3f});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->wi, (Vec3{0, 0, 1}));
  EXPECT_EQ(s->distance, 2);
  EXPECT_EQ(s->L, Rgb(0.25f, 0.5f, 1));
  EXPECT_EQ(s->pdf, 1);
  EXPECT_TRUE(s->is_delta);
}

TEST(PointLight, IsEmptyWhereItIsInfinite) {
  const Light light(PointLight{light_position, Rgb(1)});
  EXPECT_FALSE(light.sample(light_position, {}));
  const Light at_origin(PointLight{{}, Rgb(1)});
  EXPECT_FALSE(at_origin.sample({1e-30f, 0, 0}, {}));
  const auto near = at_origin.sample({1e-15f, 0, 0}, {});
  ASSERT_TRUE(near);
  EXPECT_TRUE(is_finite(near->L));
}

TEST(PointLight, IsEmptyWithoutIntensity) {
  EXPECT_FALSE(Light(PointLight{light_position, Rgb()}).sample({}, {}));
}

TEST(PointLight, PowerIsTheIntensityOverAllDirections) {
  EXPECT_FLOAT_EQ(Light(PointLight{light_position, Rgb(1, 0, 2)}).power(9).b, 8 * pi);
}

TEST(PointLight, GivesItsPointForJointSampling) {
  const Light light(PointLight{light_position, Rgb(3)});
  const auto point = light.sample_point({0.1f, 0.2f});
  ASSERT_TRUE(point);
  EXPECT_EQ(point->on.p, light_position);
  EXPECT_TRUE(point->is_delta);
  EXPECT_EQ(point->pdf_area, 1);
  EXPECT_EQ(light.emission(point->on, {0, 1, 0}), Rgb(3));
  const auto extent = light.extent();
  ASSERT_TRUE(extent);
  EXPECT_TRUE(extent->box.contains(light_position));
  EXPECT_EQ(extent->cos_cone, -1);
}

SpotLight spot(float total_degrees, float start_degrees) {
  return {light_position,
          {0, 0, -1},
          Rgb(2),
          std::cos(radians(total_degrees)),
          std::cos(radians(start_degrees))};
}

TEST(SpotLight, HasTheSmoothEdgeOfPbrt) {
  const SpotLight s = spot(30, 20);
  const auto at = [&](float cosine) {
    return s.intensity({std::sqrt(1 - sqr(cosine)), 0, -cosine}).r;
  };
  EXPECT_EQ(at(1), 2);
  EXPECT_EQ(at(std::cos(radians(19.9f))), 2);
  EXPECT_EQ(at(std::cos(radians(30.1f))), 0);
  EXPECT_EQ(at(-1), 0);
  // The cubic step 3 t^2 - 2 t^3 in the cosine.
  EXPECT_NEAR(at(std::lerp(s.cos_total, s.cos_falloff_start, 0.5f)), 1, 1e-4f);
  EXPECT_NEAR(at(std::lerp(s.cos_total, s.cos_falloff_start, 0.25f)), 2 * 0.15625f, 1e-4f);
}

TEST(SpotLight, PowerIsTheIntegralOfTheIntensity) {
  for (const auto& [total, start] :
       {std::pair{30.0f, 20.0f}, {120.0f, 10.0f}, {45.0f, 45.0f}}) {
    const SpotLight s = spot(total, start);
    const auto over_cosine = [&](double c) {
      const auto cosine = static_cast<float>(c);
      return double{s.intensity({std::sqrt(1 - sqr(cosine)), 0, -cosine}).g};
    };
    const double inside = quadrature(over_cosine, double{s.cos_falloff_start} + 1e-6, 1);
    const double edge = total > start ? quadrature(over_cosine, double{s.cos_total},
                                                   double{s.cos_falloff_start})
                                      : 0;
    const double expected = 2 * double{pi} * (inside + edge);
    EXPECT_NEAR(double{Light(s).power(1).g}, expected, 1e-4 * expected);
  }
}

TEST(SpotLight, LightsOnlyItsCone) {
  const Light light(spot(30, 20));
  const auto below = light.sample(light_position - Vec3{0, 0, 4}, {});
  ASSERT_TRUE(below);
  EXPECT_FLOAT_EQ(below->L.r, 2.0f / 16);
  EXPECT_EQ(below->wi, (Vec3{0, 0, 1}));
  EXPECT_FALSE(light.sample(light_position + Vec3{0, 0, 4}, {}));
  EXPECT_FALSE(light.sample(light_position + Vec3{4, 0, -1}, {}));
  const auto extent = light.extent();
  ASSERT_TRUE(extent);
  EXPECT_EQ(extent->axis, (Vec3{0, 0, -1}));
  EXPECT_FLOAT_EQ(extent->cos_cone, std::cos(radians(30)));
}

TEST(SpotLight, SampleAgreesWithEmission) {
  const Light light(spot(60, 5));
  const Vec3 p{1.5f, 2.2f, 1};
  const auto s = light.sample(p, {});
  const auto point = light.sample_point({});
  ASSERT_TRUE(s && point);
  const Rgb intensity = light.emission(point->on, -s->wi);
  EXPECT_FLOAT_EQ(s->L.r, intensity.r / distance_squared(point->on.p, p));
}

TEST(SpotLight, MayHaveNoWidth) {
  const Light light(spot(0, 0));
  EXPECT_FALSE(light.sample({5, 5, -5}, {}));
  EXPECT_EQ(light.power(1).r, 0);
}

TEST(PointLikeLights, CannotBeHit) {
  for (const Light& light : {Light(PointLight{light_position, Rgb(1)}), Light(spot(30, 20)),
                             Light(DistantLight{{0, 0, 1}, Rgb(1)})}) {
    EXPECT_EQ(light.pdf(Vec3{0, 0, 1}), 0);
    EXPECT_EQ(light.pdf({}, SurfacePoint{}), 0);
    EXPECT_EQ(light.environment({0, 0, 1}), Rgb());
    EXPECT_FALSE(light.is_environment());
  }
}

TEST(DistantLight, IsTheSameEverywhere) {
  const Light light(DistantLight{{0, 1, 0}, Rgb(5)});
  EXPECT_TRUE(light.is_infinite());
  const auto s = light.sample({100, -7, 3}, {});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->wi, (Vec3{0, 1, 0}));
  EXPECT_EQ(s->L, Rgb(5));
  EXPECT_EQ(s->distance, infinity);
  EXPECT_TRUE(s->is_delta);
  EXPECT_FLOAT_EQ(light.power(2).r, 5 * pi * 4);
  EXPECT_FALSE(light.sample_point({}));
  EXPECT_FALSE(light.extent());
}

}  // namespace
}  // namespace tyndall
