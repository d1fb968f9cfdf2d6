// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "materials/bsdf_cases.h"
#include "support/chi_square.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

class BsdfSampling : public testing::TestWithParam<BsdfCase> {};
INSTANTIATE_TEST_SUITE_P(All, BsdfSampling, testing::ValuesIn(bsdf_cases()),
                         [](const auto& test) { return test.param.name; });

constexpr int cases = 28;

TEST_P(BsdfSampling, MatchesItsDensity) {
  const Vec3 wo = GetParam().wo();
  const Bsdf bsdf = GetParam().bsdf();
  RandomStream lobe(7);
  const auto draw = [&](Vec2 u) -> std::optional<Vec3> {
    const auto s = bsdf.sample(wo, lobe.next_1d(), u);
    if (!s) return std::nullopt;
    return s->wi;
  };
  const auto pdf = [&](Vec3 wi) { return double{bsdf.pdf(wo, wi)}; };
  const ChiSquareResult r = chi_square_sphere(draw, pdf, 150'000);
  EXPECT_GT(r.p_value, sidak(0.01, cases)) << r;
  EXPECT_LT(r.mass, 1 + 2e-4);
  EXPECT_GT(r.mass, 0.4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
}

TEST_P(BsdfSampling, ReturnsWhatEvalAndPdfSay) {
  const Vec3 wo = GetParam().wo();
  const Bsdf bsdf = GetParam().bsdf();
  RandomStream random(8);
  for (int i = 0; i < 5000; ++i) {
    const float u_lobe = random.next_1d();
    const auto s = bsdf.sample(wo, u_lobe, random.next_2d());
    if (!s) continue;
    ASSERT_NEAR(length(s->wi), 1, 1e-6f);
    ASSERT_FALSE(s->is_specular);
    ASSERT_EQ(s->is_transmission, s->wi.z * wo.z < 0);
    const BsdfValue v = bsdf.evaluate(wo, s->wi);
    ASSERT_NEAR(s->pdf, v.pdf, 1e-3f * v.pdf);
    ASSERT_NEAR(s->value.g, v.value.g, 1e-3f * v.value.g);
    ASSERT_TRUE(is_finite(s->value) && s->value.r >= 0);
    // Sampling visible normals leaves a weight below one but for the radiance scale.
    ASSERT_LE(max_component(s->value) / s->pdf, 1.001f / sqr(s->eta));
  }
}

TEST_P(BsdfSampling, ExtremeNumbersAreSafe) {
  const float values[] = {0, 0x1p-24f, 0.5f, one_minus_epsilon};
  for (const float cosine : {1.0f, 0.5f, 1e-3f, 1e-6f, -1e-6f, -1.0f})
    for (const float lobe : values)
      for (const float x : values)
        for (const float y : values) {
          const auto s =
              GetParam().bsdf().sample(spherical_direction(cosine, 0.4f), lobe, {x, y});
          if (!s) continue;
          EXPECT_TRUE(s->pdf > 0 && std::isfinite(s->pdf));
          EXPECT_TRUE(is_finite(s->value));
          EXPECT_NEAR(length(s->wi), 1, 1e-5f);
        }
}

TEST(DiffuseBsdf, DrawsTheCosineOnTheSideOfTheViewer) {
  const Material material = DiffuseBsdf{Rgb(0.5f)};
  for (const float side : {1.0f, -1.0f}) {
    const Bsdf bsdf(material, {0, 0, 1}, {0, 0, 1});
    RandomStream random(2);
    RunningMoments z;
    for (int i = 0; i < 50'000; ++i)
      z.add(double{bsdf.sample({0, 0, side}, 0, random.next_2d())->wi.z});
    EXPECT_GT(z_p_value(z, double{side} * 2 / 3), 0.003);
  }
}

// A signed moment from outside the microfacet model: nearly smooth glass must bend as Snell
// says, and nearly smooth metal must reflect as a mirror.
TEST(RoughBsdfs, ApproachTheSmoothDirections) {
  const float sin_o = 0.6f, cos_o = 0.8f;
  const Vec3 wo{sin_o, 0, cos_o};
  RandomStream random(3);
  const Material glass = DielectricBsdf{1.5f, 0.005f, 0.005f};
  const Material metal = ConductorBsdf{Rgb(0.2f), Rgb(4), 0.005f, 0.005f};
  RunningMoments refracted, reflected;
  for (int i = 0; i < 20'000; ++i) {
    const auto g = Bsdf(glass, {0, 0, 1}, {0, 0, 1}).sample(wo, 0.9f, random.next_2d());
    const auto m = Bsdf(metal, {0, 0, 1}, {0, 0, 1}).sample(wo, 0, random.next_2d());
    if (g) refracted.add(double{g->wi.x});
    if (m) reflected.add(double{m->wi.x});
  }
  EXPECT_NEAR(refracted.mean(), -0.4, 1e-3);
  EXPECT_NEAR(reflected.mean(), -0.6, 1e-3);
}

}  // namespace
}  // namespace tyndall
