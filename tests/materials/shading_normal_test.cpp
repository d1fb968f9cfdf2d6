// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/statistical_tests.h"
#include "tyndall/materials/bsdf.h"
#include "tyndall/sampling/random.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

class ShadingNormals : public testing::TestWithParam<Material> {};
INSTANTIATE_TEST_SUITE_P(Materials, ShadingNormals,
                         testing::Values(Material(DiffuseBsdf{Rgb(0.5f)}),
                                         Material(ConductorBsdf{Rgb(0.2f), Rgb(3), 0.5f,
                                                                0.5f}),
                                         Material(ConductorBsdf{Rgb(0.2f), Rgb(3), 0, 0}),
                                         Material(DielectricBsdf{1.5f, 0.5f, 0.5f}),
                                         Material(DielectricBsdf{1.5f, 0, 0})));

constexpr Vec3 ng{0, 0, 1};
const Vec3 ns = normalize({0.8f, 0.3f, 0.5f});

TEST_P(ShadingNormals, NeverLeak) {
  const Bsdf bsdf(GetParam(), ng, ns);
  const bool can_transmit = std::holds_alternative<DielectricBsdf>(GetParam());
  RandomStream random(1);
  int drawn = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 wo = sample_uniform_sphere(random.next_2d());
    const float u_lobe = random.next_1d();
    const auto s = bsdf.sample(wo, u_lobe, random.next_2d());
    if (s) {
      ++drawn;
      ASSERT_GT(dot(wo, ng) * dot(wo, ns), 0);
      ASSERT_EQ(s->is_transmission, dot(wo, ng) * dot(s->wi, ng) < 0);
      ASSERT_TRUE(can_transmit || !s->is_transmission);
    }
    const Vec3 wi = sample_uniform_sphere(random.next_2d());
    const bool same_side = dot(wo, ng) * dot(wi, ng) > 0;
    if (!same_side && !can_transmit) {
      ASSERT_EQ(bsdf.eval(wo, wi), Rgb());
    }
    if (dot(wi, ng) * dot(wi, ns) < 0) {
      ASSERT_EQ(bsdf.eval(wo, wi), Rgb());
      ASSERT_EQ(bsdf.pdf(wo, wi), 0);
    }
  }
  EXPECT_GT(drawn, 2000);
}

TEST_P(ShadingNormals, SamplesAgreeWithEvalInWorldSpace) {
  const Bsdf bsdf(GetParam(), ng, ns);
  if (bsdf.is_specular()) return;
  RandomStream random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 wo = sample_uniform_sphere(random.next_2d());
    const float u_lobe = random.next_1d();
    const auto s = bsdf.sample(wo, u_lobe, random.next_2d());
    if (!s || magnitude(dot(s->wi, ns)) < 0.01f || magnitude(dot(wo, ns)) < 0.01f) continue;
    ASSERT_NEAR(bsdf.pdf(wo, s->wi), s->pdf, 2e-3f * s->pdf);
    ASSERT_NEAR(bsdf.eval(wo, s->wi).r, s->value.r, 2e-3f * s->value.r);
  }
}

TEST(ShadingNormal, IsWhatDiffuseReflectionIsAround) {
  const Material material = DiffuseBsdf{Rgb(1)};
  const Vec3 tilted = normalize({0.1f, 0, 1});
  const Bsdf bsdf(material, ng, tilted);
  EXPECT_NEAR(bsdf.eval(ng, tilted).r, inv_pi, 1e-6f);
  EXPECT_NEAR(bsdf.eval(tilted, ng).r, dot(tilted, ng) * inv_pi, 1e-6f);
}

}  // namespace
}  // namespace tyndall
