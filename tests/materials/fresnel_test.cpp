// SPDX-License-Identifier: Apache-2.0
#include "tyndall/materials/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace tyndall {
namespace {

// Fresnel's equations in complex numbers, as they stand in textbooks.
double textbook(double cos_i, std::complex<double> eta) {
  const std::complex<double> cos_t = std::sqrt(1.0 - (1 - cos_i * cos_i) / (eta * eta));
  const auto parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const auto perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5 * (std::norm(parallel) + std::norm(perpendicular));
}

TEST(DielectricFresnel, MatchesTheEquations) {
  for (const float eta : {1.0f, 1.001f, 1.33f, 1.5f, 2.4f, 0.7f})
    for (int i = 1; i <= 50; ++i) {
      const float cosine = static_cast<float>(i) / 50;
      EXPECT_NEAR(double{dielectric_fresnel(cosine, eta)},
                  textbook(double{cosine}, double{eta}), 1e-5)
          << cosine << " " << eta;
      EXPECT_NEAR(double{dielectric_fresnel(-cosine, eta)},
                  textbook(double{cosine}, 1 / double{eta}), 1e-5)
          << -cosine << " " << eta;
    }
}

TEST(DielectricFresnel, KnowsItsLandmarks) {
  EXPECT_FLOAT_EQ(dielectric_fresnel(1, 1.5f), 0.04f);
  EXPECT_FLOAT_EQ(dielectric_fresnel(-1, 1.5f), 0.04f);
  EXPECT_EQ(dielectric_fresnel(0, 1.5f), 1);
  // At Brewster's angle only the perpendicular part remains: half of ((1 - n^2) / (1 +
  // n^2))^2.
  const float n = 1.5f, cos_brewster = 1 / std::sqrt(1 + sqr(n));
  EXPECT_NEAR(dielectric_fresnel(cos_brewster, n), 0.5f * sqr((1 - sqr(n)) / (1 + sqr(n))),
              1e-6f);
  // Beyond the critical angle all is reflected.
  const float cos_critical = std::sqrt(1 - 1 / sqr(n));
  EXPECT_EQ(dielectric_fresnel(-0.99f * cos_critical, n), 1);
  EXPECT_LT(dielectric_fresnel(-1.01f * cos_critical, n), 0.9f);
}

TEST(DielectricFresnel, IsTheSameFromBothSidesOfARay) {
  const float eta = 1.7f, cos_i = 0.6f;
  const float cos_t = std::sqrt(1 - (1 - sqr(cos_i)) / sqr(eta));
  EXPECT_NEAR(dielectric_fresnel(cos_i, eta), dielectric_fresnel(-cos_t, eta), 1e-6f);
}

TEST(ConductorFresnel, MatchesTheEquations) {
  for (const float eta : {0.05f, 0.2f, 1.0f, 3.0f})
    for (const float k : {0.0f, 0.5f, 3.0f, 9.0f})
      for (int i = 1; i <= 50; ++i) {
        if (k == 0 && eta < 1) continue;  // beyond the critical angle, no metal
        const float cosine = static_cast<float>(i) / 50;
        EXPECT_NEAR(double{conductor_fresnel(cosine, eta, k)},
                    textbook(double{cosine}, {double{eta}, double{k}}), 1e-5)
            << cosine << " " << eta << " " << k;
      }
}

TEST(ConductorFresnel, ReflectsAllAtTheHorizon) {
  for (const float k : {0.0f, 2.0f})
    for (const float cosine : {0.0f, 1e-20f, 1e-7f})
      EXPECT_NEAR(conductor_fresnel(cosine, 1, k), 1, 1e-5f);
}

TEST(ConductorFresnel, WithoutAbsorptionIsADielectric) {
  EXPECT_NEAR(conductor_fresnel(0.3f, 1.5f, 0), dielectric_fresnel(0.3f, 1.5f), 1e-6f);
}

TEST(Refract, ObeysSnellsLaw) {
  const float eta = 1.5f;
  const Vec3 wo = normalize({0.3f, -0.5f, 0.4f});
  const auto r = refract(wo, {0, 0, 1}, eta);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->eta, eta);
  EXPECT_LT(r->wi.z, 0);
  EXPECT_NEAR(length(r->wi), 1, 1e-6f);
  // Tangential parts are opposite and in the ratio of the indices.
  EXPECT_NEAR(r->wi.x, -wo.x / eta, 1e-6f);
  EXPECT_NEAR(r->wi.y, -wo.y / eta, 1e-6f);
}

TEST(Refract, GoesBackTheSameWay) {
  const Vec3 wo = normalize({0.3f, -0.5f, 0.4f});
  const auto there = refract(wo, {0, 0, 1}, 1.5f);
  const auto back = refract(there->wi, {0, 0, 1}, 1.5f);
  ASSERT_TRUE(back);
  EXPECT_LT(distance(back->wi, wo), 1e-6f);
  EXPECT_FLOAT_EQ(back->eta, 1 / 1.5f);
}

TEST(Refract, IsEmptyBeyondTheCriticalAngle) {
  EXPECT_FALSE(refract(normalize({1, 0, -0.5f}), {0, 0, 1}, 1.5f));
  EXPECT_TRUE(refract(normalize({1, 0, 0.01f}), {0, 0, 1}, 1.5f));
}

}  // namespace
}  // namespace tyndall
