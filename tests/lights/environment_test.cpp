// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "support/chi_square.h"
#include "tyndall/lights/light.h"
#include "tyndall/lights/octahedral.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

ChiSquareResult compare(const Light& light, uint64_t seed) {
  const auto draw = [&](Vec2 u) -> std::optional<Vec3> {
    const auto s = light.sample({1, 2, 3}, u);
    if (!s) return std::nullopt;
    return s->wi;
  };
  return chi_square_sphere(
      draw, [&](Vec3 w) { return double{light.pdf(w)}; }, 200'000, seed);
}

TEST(ConstantEnvironment, IsUniform) {
  const Light light(ConstantEnvironment{Rgb(1, 2, 3)});
  const ChiSquareResult r = compare(light, 1);
  EXPECT_GT(r.p_value, 0.005) << r;
  EXPECT_NEAR(r.mass, 1, 1e-4);
  for (const RunningMoments& moment : r.moments) EXPECT_GT(z_p_value(moment, 0), 0.003);
  EXPECT_EQ(light.environment({0, 1, 0}), Rgb(1, 2, 3));
  EXPECT_EQ(light.sample({}, {0.2f, 0.7f})->L, Rgb(1, 2, 3));
  // Radiance L over the projected area of a sphere from all directions.
  EXPECT_FLOAT_EQ(light.power(3).r, 4 * pi * pi * 9);
  EXPECT_TRUE(light.is_infinite() && light.is_environment());
}

// Bright towards +x in the light's space, with a black and a dim part.
ImageEnvironment make_image(const Transform& world_from_light) {
  const int n = 8;
  std::vector<Rgb> pixels;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      pixels.push_back(x == 7 && y == 3 ? Rgb(40, 20, 10)
                       : y < 2          ? Rgb()
                                        : Rgb(0.3f, 0.1f, 0.2f));
  return ImageEnvironment(world_from_light, n, pixels, 2);
}

class ImageEnvironments : public testing::TestWithParam<Transform> {};
INSTANTIATE_TEST_SUITE_P(Orientations, ImageEnvironments,
                         testing::Values(Transform(), Transform::rotate(-90, {1, 0, 0}),
                                         Transform::rotate(37, {1, 2, -1}),
                                         Transform::scale({-1, 1, 1}),
                                         Transform::translate({5, 6, 7}) *
                                             Transform::scale({3, 3, 3})));

TEST_P(ImageEnvironments, SamplesMatchTheDensity) {
  const Light light(make_image(GetParam()));
  const ChiSquareResult r = compare(light, 2);
  EXPECT_GT(r.p_value, sidak(0.01, 5)) << r;
  EXPECT_NEAR(r.mass, 1, 2e-4);
  EXPECT_EQ(r.missing, 0);
  // Rounding may carry a direction over the edge of a pixel, into a black one.
  EXPECT_LT(r.samples_of_zero_pdf, 10);
}

TEST_P(ImageEnvironments, InvertsItsSamples) {
  RandomStream random(4);
  for (const Light& light :
       {Light(make_image(GetParam())), Light(ConstantEnvironment{Rgb(1)})})
    for (int i = 0; i < 2000; ++i) {
      const Vec2 u = random.next_2d();
      const auto s = light.sample({}, u);
      ASSERT_TRUE(s);
      const Vec2 back = light.invert(s->wi);
      EXPECT_NEAR(back.x, u.x, 1e-3f);
      EXPECT_NEAR(back.y, u.y, 1e-3f);
    }
}

// Estimates of integrals of radiance against closed forms over pixels.
TEST_P(ImageEnvironments, EstimatesIrradianceMoments) {
  const ImageEnvironment image = make_image(GetParam());
  const Light light(image);
  Vec3 expected_direction{};
  double expected_total = 0;
  const int subdivision = 32, n = 8 * subdivision;
  for (int i = 0; i < n * n; ++i) {
    const Vec2 p{(static_cast<float>(i % n) + 0.5f) / n,
                 (static_cast<float>(i / n) + 0.5f) / n};
    const float L = image.lookup(p).g * 4 * pi / (n * n);
    expected_direction += normalize(GetParam().vector(octahedral_direction(p))) * L;
    expected_total += double{L};
  }
  RandomStream random(3);
  RunningMoments total, x, y, z;
  for (int k = 0; k < 100'000; ++k) {
    const auto s = light.sample({}, random.next_2d());
    ASSERT_TRUE(s);
    ASSERT_NEAR(length(s->wi), 1, 1e-6f);
    const double L = double{s->L.g / s->pdf};
    total.add(L);
    x.add(L * double{s->wi.x});
    y.add(L * double{s->wi.y});
    z.add(L * double{s->wi.z});
  }
  EXPECT_GT(z_p_value(total, expected_total), sidak(0.01, 20));
  EXPECT_GT(z_p_value(x, double{expected_direction.x}), sidak(0.01, 20));
  EXPECT_GT(z_p_value(y, double{expected_direction.y}), sidak(0.01, 20));
  EXPECT_GT(z_p_value(z, double{expected_direction.z}), sidak(0.01, 20));
}

TEST_P(ImageEnvironments, SamplePdfAndRadianceAgreeWithTheirFunctions) {
  const Light light(make_image(GetParam()));
  RandomStream random(4);
  int differ = 0;
  for (int k = 0; k < 20'000; ++k) {
    const auto s = light.sample({}, random.next_2d());
    if (s->pdf != light.pdf(s->wi) || s->L != light.environment(s->wi)) ++differ;
  }
  EXPECT_LT(differ, 3);  // those on the edges of pixels
}

TEST(ImageEnvironment, PutsPixelsWhereTheMapDoes) {
  const Light light(make_image(Transform()));
  EXPECT_EQ(light.environment(octahedral_direction({7.5f / 8, 3.5f / 8})), Rgb(80, 40, 20));
  EXPECT_EQ(light.environment(octahedral_direction({7.5f / 8, 0.5f / 8})), Rgb());
  EXPECT_GT(light.environment(normalize({1, -0.1f, 0.1f})).r, 1);
}

TEST(ImageEnvironment, PowerIsThatOfItsMean) {
  const Light light(ImageEnvironment(Transform(), 1, {Rgb(1, 2, 3)}, 2));
  EXPECT_FLOAT_EQ(light.power(1.5f).g,
                  Light(ConstantEnvironment{Rgb(2, 4, 6)}).power(1.5f).g);
}

TEST(ImageEnvironment, BlackImageGivesNothing) {
  const Light light(ImageEnvironment(Transform(), 2, std::vector<Rgb>(4), 1));
  EXPECT_FALSE(light.sample({}, {0.3f, 0.6f}));
  EXPECT_TRUE(std::isfinite(light.pdf(Vec3{0, 0, 1})));
}

}  // namespace
}  // namespace tyndall
