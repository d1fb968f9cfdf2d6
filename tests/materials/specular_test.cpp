// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/materials/bsdf.h"
#include "tyndall/materials/fresnel.h"

namespace tyndall {
namespace {

constexpr Vec3 up{0, 0, 1};

TEST(SmoothConductor, IsAMirror) {
  const Material material =
      ConductorBsdf{Rgb(0.2f, 0.9f, 1.1f), Rgb(3.9f, 2.4f, 2.2f), 0, 0};
  const Bsdf bsdf(material, up, up);
  EXPECT_TRUE(bsdf.is_specular());
  for (const float side : {1.0f, -1.0f}) {
    const Vec3 wo{0.6f, 0, 0.8f * side};
    const auto s = bsdf.sample(wo, 0.5f, {0.5f, 0.5f});
    ASSERT_TRUE(s);
    EXPECT_LT(distance(s->wi, {-0.6f, 0, 0.8f * side}), 1e-6f);
    EXPECT_FLOAT_EQ(s->value.r / s->pdf, conductor_fresnel(0.8f, 0.2f, 3.9f));
    EXPECT_FLOAT_EQ(s->value.b / s->pdf, conductor_fresnel(0.8f, 1.1f, 2.2f));
    EXPECT_TRUE(s->is_specular && !s->is_transmission);
    EXPECT_EQ(bsdf.eval(wo, s->wi), Rgb());
    EXPECT_EQ(bsdf.pdf(wo, s->wi), 0);
    EXPECT_FLOAT_EQ(bsdf.albedo(wo).r, conductor_fresnel(0.8f, 0.2f, 3.9f));
  }
}

TEST(SmoothDielectric, ReflectsAndRefractsByFresnel) {
  const Material material = DielectricBsdf{1.5f, 0, 0};
  const Bsdf bsdf(material, up, up);
  const Vec3 wo{0.6f, 0, 0.8f};
  const float reflected = dielectric_fresnel(0.8f, 1.5f);
  const auto r = bsdf.sample(wo, 0.99f * reflected, {});
  ASSERT_TRUE(r && r->is_specular && !r->is_transmission);
  EXPECT_FLOAT_EQ(r->value.g / r->pdf, 1);
  EXPECT_FLOAT_EQ(r->pdf, reflected);
  EXPECT_EQ(r->eta, 1);
  const auto t = bsdf.sample(wo, 1.01f * reflected, {});
  ASSERT_TRUE(t && t->is_specular && t->is_transmission);
  EXPECT_FLOAT_EQ(t->pdf, 1 - reflected);
  EXPECT_FLOAT_EQ(t->value.g / t->pdf, 1 / sqr(1.5f));
  EXPECT_NEAR(t->wi.x, -0.4f, 1e-6f);
  EXPECT_NEAR(t->wi.z, -std::sqrt(1 - 0.16f), 1e-6f);
  EXPECT_EQ(t->eta, 1.5f);
}

TEST(SmoothDielectric, RadianceIsRestoredBehindASlab) {
  const Material material = DielectricBsdf{1.5f, 0, 0};
  const Bsdf bsdf(material, up, up);
  const auto in = bsdf.sample({0.6f, 0, 0.8f}, 0.99f, {});
  const auto out = bsdf.sample(-in->wi * -1, 0.99f, {});
  ASSERT_TRUE(in && out);
  EXPECT_LT(distance(out->wi, {0.6f, 0, 0.8f}), 1e-6f);
  EXPECT_FLOAT_EQ(in->value.r / in->pdf * out->value.r / out->pdf, 1);
}

TEST(SmoothDielectric, ReflectsAllBeyondTheCriticalAngle) {
  const Material material = DielectricBsdf{1.5f, 0, 0};
  const Vec3 wo = normalize({1, 0, -0.4f});
  for (const float lobe : {0.0f, 0.5f, one_minus_epsilon}) {
    const auto s = Bsdf(material, up, up).sample(wo, lobe, {});
    ASSERT_TRUE(s);
    EXPECT_FALSE(s->is_transmission);
    EXPECT_EQ(s->pdf, 1);
  }
}

TEST(SmoothDielectric, OfIndexOneIsNotThere) {
  const Material material = DielectricBsdf{1, 0.5f, 0.5f};
  const Bsdf bsdf(material, up, up);
  EXPECT_TRUE(bsdf.is_specular());
  const Vec3 wo = normalize({0.3f, 0.2f, 0.5f});
  const auto s = bsdf.sample(wo, 0, {});
  ASSERT_TRUE(s);
  EXPECT_LT(distance(s->wi, -wo), 1e-6f);
  EXPECT_EQ(s->value, Rgb(1));
}

}  // namespace
}  // namespace tyndall
