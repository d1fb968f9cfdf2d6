// SPDX-License-Identifier: Apache-2.0
#include "tyndall/materials/ggx.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/chi_square.h"

namespace tyndall {
namespace {

struct Case {
  float alpha_x, alpha_y, cosine;
};

class GgxCases : public testing::TestWithParam<Case> {
 protected:
  Ggx ggx() const { return {GetParam().alpha_x, GetParam().alpha_y}; }
  Vec3 w() const { return spherical_direction(GetParam().cosine, 0.7f); }
};
INSTANTIATE_TEST_SUITE_P(Extremes, GgxCases,
                         testing::Values(Case{1, 1, 0.9f}, Case{0.5f, 0.5f, 0.3f},
                                         Case{0.3f, 0.3f, 0.01f}, Case{0.3f, 0.3f, -0.5f},
                                         Case{0.1f, 0.6f, 0.5f}, Case{0.1f, 0.1f, 1},
                                         Case{1, 1, 0.001f}));

TEST_P(GgxCases, VisibleNormalsMatchTheirDensity) {
  const auto draw = [&](Vec2 u) { return ggx().sample_visible(w(), u); };
  const auto pdf = [&](Vec3 m) {
    const float side = dot(w(), m) * w().z;
    return m.z > 0 && side > 0 ? double{ggx().visible_density(w(), m)} : 0.0;
  };
  const ChiSquareResult r = chi_square_sphere(draw, pdf, 200'000, 1, {.concentration = 3});
  EXPECT_GT(r.p_value, sidak(0.01, 7)) << r;
  // The visible facets cover exactly what is seen of the surface.
  EXPECT_NEAR(r.mass, 1, 3e-4);
}

TEST_P(GgxCases, FacetsCoverTheSurface) {
  const ChiSquareResult r = chi_square_sphere(
      [&](Vec2) { return std::optional<Vec3>(); },
      [&](Vec3 m) { return m.z > 0 ? double{ggx().density(m) * m.z} : 0.0; }, 1000);
  EXPECT_NEAR(r.mass, 1, 3e-4);
}

TEST_P(GgxCases, VisibilityIsASymmetricShare) {
  for (const float cosine : {0.9f, 0.2f, 1e-3f, 0.0f}) {
    const Vec3 other = spherical_direction(cosine, 2.5f);
    const float v = ggx().visibility(w(), other);
    EXPECT_TRUE(v >= 0 && v <= 1);
    EXPECT_FLOAT_EQ(v, ggx().visibility(other, w()));
  }
}

TEST(Ggx, MasksHalfAtAKnownAngle) {
  // lambda = (sqrt(1 + (alpha tan)^2) - 1) / 2 is 1/2 where alpha tan = sqrt 3; with the
  // normal as the other direction the visibility is 1 / (1 + lambda) = 2/3.
  const Ggx ggx(0.5f, 0.5f);
  const float tangent = std::sqrt(3.0f) / 0.5f;
  const Vec3 w = normalize({tangent, 0, 1});
  EXPECT_NEAR(ggx.visibility(w, {0, 0, 1}), 2.0f / 3, 1e-6f);
}

TEST(Ggx, IsSmoothBelowPbrtsThreshold) {
  EXPECT_TRUE(Ggx::is_smooth(0, 0));
  EXPECT_TRUE(Ggx::is_smooth(9e-4f, 0));
  EXPECT_FALSE(Ggx::is_smooth(0.01f, 0));
}

}  // namespace
}  // namespace tyndall
