// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/point_normal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/chi_square.h"
#include "support/quadrature.h"
#include "techniques/technique_checks.h"
#include "tyndall/techniques/binned_distance.h"

namespace tyndall {
namespace {

static_assert(DistanceTechnique<PointNormalSampling>);

const Vec3 normals[] = {normalize({-1, 0, 0}),      normalize({-1, 0, 1}),
                        normalize({-1, 0, -1}),     normalize({-0.5f, 1, 0.3f}),
                        normalize({0.1f, 0.2f, 1}), normalize({0.2f, 0.1f, -1})};

/// n . (point at t - pivot), which the lit side has positive.
double height(const Geometry& geometry, Vec3 n, double t) {
  return -double(n.x) * geometry.h + double(n.z) * geometry.s(t);
}

/// The indefinite integral of height / r^3: (a s / h^2 - b) / r for a height of a + b s.
double integral(const Geometry& geometry, Vec3 n, double t) {
  const double h = geometry.h, a = -double(n.x) * h;
  if (t == infinity) return a / (h * h);
  return (a * geometry.s(t) / (h * h) - n.z) / geometry.r(t);
}

TEST(PointNormal, IsTheCosineOverTheSquare) {
  for (const Geometry& geometry : geometries()) {
    // The reference takes differences that leave nothing in the extremes.
    if (geometry.h < 1e-3f || geometry.h > 1e3f || std::abs(geometry.foot) > 1e3f) continue;
    for (const Vec3 n : normals) {
      SCOPED_TRACE(testing::Message() << geometry.name << ", normal " << n.x << " " << n.z);
      const PointNormalSampling technique(geometry.ray(), geometry.pivot(), n,
                                          geometry.t_min, geometry.t_max);
      const double edge = geometry.foot + double(n.x) * geometry.h / n.z;
      double begin = geometry.t_min, end = geometry.t_max;
      if (n.z > 0) begin = std::max(begin, edge);
      if (n.z < 0) end = std::min(end, edge);
      if (begin >= end ||
          height(geometry, n, 0.5 * (begin + std::min(end, begin + 1))) <= 0) {
        EXPECT_FALSE(technique.sample(0.5f));
        continue;
      }
      const double low = integral(geometry, n, begin);
      const double all = integral(geometry, n, end) - low;
      for (int i = 0; i < 100; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 100;
        const auto sample = technique.sample(u);
        ASSERT_TRUE(sample.has_value()) << u;
        const double t = sample->t, r = geometry.r(t);
        const double expected = height(geometry, n, t) / (r * r * r * all);
        // Near the light's own plane the density vanishes, and with it its relative
        // precision.
        const double to_edge =
            n.z != 0 ? 4 * ulp(edge) / std::max(std::abs(t - edge), 1e-30) : 0;
        const double slack = 4e-6 + position_error(geometry, t) + to_edge;
        EXPECT_NEAR(sample->pdf_t / expected, 1, slack) << "t = " << t;
        const double tolerance = 1e-5 + 8 * (ulp(t) + ulp(begin)) * expected;
        EXPECT_NEAR((integral(geometry, n, t) - low) / all, u, tolerance) << "t = " << t;
        EXPECT_NEAR(technique.invert(sample->t), u, tolerance) << "t = " << t;
      }
    }
  }
}

TEST(PointNormal, SamplesFollowTheirPdf) {
  for (const Vec3 n : normals) {
    const PointNormalSampling technique({{0, 0, 0}, {0, 0, 1}}, {1, 0, 2}, n, 0, 5);
    if (!technique.sample(0.5f)) continue;
    const ChiSquareResult result = chi_square_line(
        [&](float u) -> std::optional<float> {
          const auto sample = technique.sample(u);
          return sample ? std::optional(sample->t) : std::nullopt;
        },
        [&](double t) { return technique.pdf_t(static_cast<float>(t)); }, 0, 5, 50'000);
    EXPECT_GT(result.p_value, sidak(0.01, std::size(normals))) << result;
    EXPECT_NEAR(result.mass, 1, 1e-4);
  }
}

TEST(PointNormal, IsEmptyBehindTheLight) {
  const Ray ray{{0, 0, 0}, {0, 0, 1}};
  EXPECT_FALSE(PointNormalSampling(ray, {1, 0, 2}, {1, 0, 0}, 0, 5).sample(0.5f));
  EXPECT_FALSE(PointNormalSampling(ray, {1, 0, 6}, {0, 0, 1}, 0, 5).sample(0.5f));
  EXPECT_EQ(PointNormalSampling(ray, {1, 0, 6}, {0, 0, 1}, 0, 5).pdf_t(1), 0);
}

}  // namespace
}  // namespace tyndall
