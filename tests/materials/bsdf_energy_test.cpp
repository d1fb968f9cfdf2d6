// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/bsdf_cases.h"
#include "support/cell_integral.h"
#include "support/chi_square.h"
#include "tyndall/materials/ggx.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

class BsdfEnergy : public testing::TestWithParam<BsdfCase> {};
INSTANTIATE_TEST_SUITE_P(All, BsdfEnergy, testing::ValuesIn(bsdf_cases()),
                         [](const auto& test) { return test.param.name; });

// The integral of f over directions with z in [z_min, z_max].
double integrate(const std::function<double(Vec3)>& f, double z_min, double z_max) {
  double sum = 0;
  const int n = 12;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += cell_integral(
          [&](double z, double phi) {
            return f(spherical_direction(static_cast<float>(z), static_cast<float>(phi)));
          },
          {std::lerp(z_min, z_max, i / double{n}),
           std::lerp(z_min, z_max, (i + 1) / double{n}), 2 * std::numbers::pi * j / n,
           2 * std::numbers::pi * (j + 1) / n});
  return sum;
}

// Energy, not radiance, is what the surface may not create: refracted radiance counts times
// the square of the relative index.
double energy_scale(const BsdfCase& c, Vec3 wi) {
  const auto* glass = std::get_if<DielectricBsdf>(&c.material);
  if (!glass || wi.z * c.cosine > 0) return 1;
  return c.cosine > 0 ? double{sqr(glass->eta)} : 1 / double{sqr(glass->eta)};
}

TEST_P(BsdfEnergy, CreatesNone) {
  const Bsdf bsdf = GetParam().bsdf();
  const auto energy = [&](Vec3 wi) {
    return double{bsdf.eval(GetParam().wo(), wi).r} * energy_scale(GetParam(), wi);
  };
  EXPECT_LE(integrate(energy, 0, 1) + integrate(energy, -1, 0), 1 + 1e-4);
}

TEST_P(BsdfEnergy, EstimatesAgreeWithQuadrature) {
  const Bsdf bsdf = GetParam().bsdf();
  const Vec3 wo = GetParam().wo();
  const auto value = [&](Vec3 wi) { return double{bsdf.eval(wo, wi).g}; };
  const double upper = integrate(value, 0, 1), lower = integrate(value, -1, 0);
  RunningMoments sampled_upper, sampled_lower;
  RandomStream random(5);
  for (int i = 0; i < 60'000; ++i) {
    const float u_lobe = random.next_1d();
    const auto s = bsdf.sample(wo, u_lobe, random.next_2d());
    const double weight = s ? double{s->value.g / s->pdf} : 0;
    sampled_upper.add(s && s->wi.z > 0 ? weight : 0);
    sampled_lower.add(s && s->wi.z < 0 ? weight : 0);
  }
  // Beside the spread, the quadrature's own error of about 1e-4 and, where all weights are
  // the same, the rounding of float.
  const auto expect_agreement = [](const RunningMoments& m, double expected) {
    EXPECT_GT(z_p_value(m.mean(), m.standard_error() + 2e-5 * expected, expected),
              sidak(0.01, 56))
        << m.mean() << " " << expected;
  };
  if (upper > 0 || sampled_upper.mean() > 0) expect_agreement(sampled_upper, upper);
  if (lower > 0 || sampled_lower.mean() > 0) expect_agreement(sampled_lower, lower);
}

// Where floats cannot tell on which side of a facet or of the critical angle a direction
// is.
bool sees_facet_edge_on(const BsdfCase& c, Vec3 wi) {
  const auto* glass = std::get_if<DielectricBsdf>(&c.material);
  const bool reflects = !glass || wi.z * c.cosine > 0;
  const float eta = reflects ? 1 : c.cosine > 0 ? glass->eta : 1 / glass->eta;
  const Vec3 m = normalize(c.wo() + wi * eta);
  return magnitude(wi.z) < 0.01f || abs_dot(wi, m) < 0.1f || abs_dot(c.wo(), m) < 0.1f;
}

// f(wo, wi) n_wi^2 = f(wi, wo) n_wo^2 [Veach97, Sec. 5.2]; plain reciprocity on one side.
TEST_P(BsdfEnergy, IsReciprocal) {
  const Bsdf bsdf = GetParam().bsdf();
  const Vec3 wo = GetParam().wo();
  RandomStream random(6);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const float cos_theta = 1 - 2 * random.next_1d();
    const Vec3 wi = spherical_direction(cos_theta, 2 * pi * random.next_1d());
    if (sees_facet_edge_on(GetParam(), wi)) continue;
    const double there =
        double{bsdf.eval(wo, wi).g / magnitude(wi.z)} * energy_scale(GetParam(), wi);
    const double back = double{bsdf.eval(wi, wo).g / magnitude(wo.z)};
    ASSERT_NEAR(there, back, 1e-3 * std::abs(back) + 1e-9);
    compared += back > 0;
  }
  EXPECT_GT(compared, 20);
}

TEST(DiffuseBsdf, ReflectsItsReflectance) {
  const Material material = DiffuseBsdf{Rgb(0.8f, 0.5f, 0.1f)};
  const Bsdf bsdf(material, {0, 0, 1}, {0, 0, 1});
  const auto value = [&](Vec3 wi) { return double{bsdf.eval({0, 0, 1}, wi).b}; };
  EXPECT_NEAR(integrate(value, 0, 1), 0.1, 1e-5);
  EXPECT_EQ(integrate(value, -1, 0), 0);
  EXPECT_EQ(bsdf.albedo({0, 0, 1}), Rgb(0.8f, 0.5f, 0.1f));
}

// What a metal that absorbs nothing reflects in a white furnace.
double furnace(float alpha, float cosine) {
  const Material material = ConductorBsdf{Rgb(1e-4f), Rgb(1e3f), alpha, alpha};
  const Bsdf bsdf(material, {0, 0, 1}, {0, 0, 1});
  RandomStream random(7);
  RunningMoments m;
  for (int i = 0; i < 100'000; ++i) {
    const auto s = bsdf.sample(spherical_direction(cosine, 0), 0, random.next_2d());
    m.add(s ? double{s->value.g / s->pdf} : 0);
  }
  return m.mean();
}

// With alpha = 1 the density is 1 / pi, and from straight above lambda_o is zero. A facet
// at angle a reflects to 2 a with G = cos(2 a) / cos(a)^2, so the light that leaves
// directly is
//   2 * integral of sin(a) cos(2 a) / cos(a) over [0, pi / 4] = 1 - log 2.
TEST(ConductorBsdf, LosesTheLightThatHitsTwoFacets) {
  EXPECT_NEAR(furnace(1, 1), 1 - std::numbers::ln2, 5e-3);
  EXPECT_NEAR(furnace(0.01f, 0.6f), 1, 1e-3);
  EXPECT_LT(furnace(0.5f, 0.6f), furnace(0.2f, 0.6f));
}

// Reflection of rough glass of vanishing roughness tends to Fresnel's share, from both
// sides.
TEST(DielectricBsdf, SplitsLightAsFresnelInTheSmoothLimit) {
  const Material rough = DielectricBsdf{1.5f, 2e-3f, 2e-3f},
                 smooth = DielectricBsdf{1.5f, 0, 0};
  for (const float cosine : {1.0f, 0.4f, -0.9f}) {
    const Vec3 wo = spherical_direction(cosine, 0);
    const auto split = [&](const Material& material) {
      const Bsdf bsdf(material, {0, 0, 1}, {0, 0, 1});
      RunningMoments up;
      RandomStream random(9);
      for (int i = 0; i < 4000; ++i) {
        const float lobe = (static_cast<float>(i) + 0.5f) / 4000;
        const auto s = bsdf.sample(wo, lobe, random.next_2d());
        up.add(s && s->wi.z > 0 ? double{s->value.g / s->pdf} : 0);
      }
      return up.mean();
    };
    EXPECT_NEAR(split(rough), split(smooth), 2e-3) << cosine;
  }
}

}  // namespace
}  // namespace tyndall
