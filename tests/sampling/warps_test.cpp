// SPDX-License-Identifier: Apache-2.0
#include "tyndall/sampling/warps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "support/chi_square.h"
#include "support/jacobian.h"
#include "support/quadrature.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// A warp to directions and what is known of it.
struct SphereWarp {
  std::string name;
  std::function<Vec3(Vec2)> sample;
  std::function<double(Vec3)> pdf;
  std::function<Vec2(Vec3)> invert;
  double mean_z;
  SphereCells cells = {};
};

void PrintTo(const SphereWarp& warp, std::ostream* out) { *out << warp.name; }

SphereWarp cone(const std::string& name, float h, double concentration) {
  return {name,
          [h](Vec2 u) { return sample_uniform_cone(u, h); },
          [h](Vec3 w) {
            return one_minus_cos(w) <= h * (1 + 1e-6f) ? double{uniform_cone_pdf(h)} : 0.0;
          },
          [h](Vec3 w) { return invert_uniform_cone(w, h); },
          1 - double{h} / 2,
          SphereCells{.pole = {0, 0, 1}, .concentration = concentration}};
}

class SphereWarps : public testing::TestWithParam<SphereWarp> {};
INSTANTIATE_TEST_SUITE_P(
    All, SphereWarps,
    testing::Values(SphereWarp{"uniform_sphere", sample_uniform_sphere,
                               [](Vec3) { return double{uniform_sphere_pdf()}; },
                               invert_uniform_sphere, 0},
                    SphereWarp{"uniform_hemisphere", sample_uniform_hemisphere,
                               [](Vec3 w) { return double{uniform_hemisphere_pdf(w.z)}; },
                               invert_uniform_hemisphere, 0.5},
                    SphereWarp{"cosine_hemisphere", sample_cosine_hemisphere,
                               [](Vec3 w) { return double{cosine_hemisphere_pdf(w.z)}; },
                               invert_cosine_hemisphere, 2.0 / 3},
                    cone("wide_cone", 1.7f, 0), cone("cone", 0.1f, 4),
                    cone("narrow_cone", 1e-5f, 16)),
    [](const auto& test) { return test.param.name; });

TEST_P(SphereWarps, MatchesItsDensity) {
  const SphereWarp& warp = GetParam();
  const ChiSquareResult r =
      chi_square_sphere(warp.sample, warp.pdf, 200'000, 1, warp.cells);
  EXPECT_GT(r.p_value, sidak(0.01, 6)) << r;
  EXPECT_NEAR(r.mass, 1, 1e-4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
  EXPECT_GT(z_p_value(r.moments[0], 0), sidak(0.01, 18));
  EXPECT_GT(z_p_value(r.moments[1], 0), sidak(0.01, 18));
  EXPECT_GT(z_p_value(r.moments[2], warp.mean_z), sidak(0.01, 18));
}

TEST_P(SphereWarps, DensityIsTheInverseJacobian) {
  const SphereWarp& warp = GetParam();
  for (const Vec2 u :
       {Vec2{0.3f, 0.2f}, Vec2{0.62f, 0.71f}, Vec2{0.15f, 0.93f}, Vec2{0.9f, 0.4f}})
    EXPECT_NEAR(warp.pdf(warp.sample(u)) * surface_jacobian(warp.sample, u), 1, 5e-3);
}

TEST_P(SphereWarps, InverseUndoesSample) {
  const SphereWarp& warp = GetParam();
  RandomStream random(1);
  for (int i = 0; i < 10'000; ++i) {
    const Vec2 u = random.next_2d();
    if (u.x < 1e-3f || u.x > 0.999f) continue;  // the pole, where azimuth means little
    const Vec3 w = warp.sample(u);
    ASSERT_NEAR(length(w), 1, 1e-6f);
    const Vec2 back = warp.invert(w);
    ASSERT_NEAR(back.x, u.x, 2e-5f);
    ASSERT_NEAR(std::remainder(back.y - u.y, 1.0f), 0, 2e-5f) << u.x << " " << u.y;
  }
}

TEST_P(SphereWarps, ExtremeNumbersGiveUnitVectorsOfPositiveDensity) {
  const float values[] = {0, 0x1p-24f, 0.5f, 1 - 0x1p-23f, one_minus_epsilon};
  for (const float x : values)
    for (const float y : values) {
      const Vec3 w = GetParam().sample({x, y});
      EXPECT_NEAR(length(w), 1, 1e-6f);
      const Vec2 back = GetParam().invert(w);
      EXPECT_TRUE(back.x >= 0 && back.x < 1 && back.y >= 0 && back.y < 1);
      EXPECT_GE(GetParam().pdf(w), GetParam().name == "cosine_hemisphere" ? 1e-5 : 0);
    }
}

TEST(ConcentricDisk, IsUniformByArea) {
  // Polar coordinates of a uniform point: r^2 and the angle are uniform.
  const auto draw = [](Vec2 u) {
    const Vec2 p = sample_concentric_disk(u);
    return Vec2{dot(p, p), azimuth_to_unit(p.x, p.y)};
  };
  const ChiSquareResult r = chi_square_square(draw, [](Vec2) { return 1.0; });
  EXPECT_GT(r.p_value, 0.005) << r;
}

TEST(ConcentricDisk, JacobianAndInverse) {
  const auto map = [](Vec2 u) {
    const Vec2 p = sample_concentric_disk(u);
    return Vec3{p.x, p.y, 0};
  };
  RandomStream random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u = random.next_2d();
    const Vec2 back = invert_concentric_disk(sample_concentric_disk(u));
    ASSERT_NEAR(back.x, u.x, 1e-6f);
    ASSERT_NEAR(back.y, u.y, 1e-6f);
  }
  for (const Vec2 u :
       {Vec2{0.3f, 0.2f}, Vec2{0.9f, 0.6f}, Vec2{0.1f, 0.6f}, Vec2{0.45f, 0.8f}})
    EXPECT_NEAR(double{concentric_disk_pdf()} * surface_jacobian(map, u), 1, 1e-3);
  EXPECT_EQ(sample_concentric_disk({0.5f, 0.5f}), Vec2{});
  EXPECT_EQ(invert_concentric_disk({}), (Vec2{0.5f, 0.5f}));
}

TEST(UniformTriangle, IsUniformAndInvertible) {
  // A point is uniform if the fraction x / (1 - y) and (1 - y)^2 are.
  const auto draw = [](Vec2 u) {
    const Vec2 b = sample_uniform_triangle(u);
    return Vec2{b.x / (1 - b.y), sqr(1 - b.y)};
  };
  const ChiSquareResult r = chi_square_square(draw, [](Vec2) { return 1.0; });
  EXPECT_GT(r.p_value, 0.005) << r;
  EXPECT_EQ(r.missing, 0);
  const auto map = [](Vec2 u) {
    const Vec2 b = sample_uniform_triangle(u);
    return Vec3{b.x, b.y, 0};
  };
  for (const Vec2 u : {Vec2{0.3f, 0.2f}, Vec2{0.2f, 0.7f}}) {
    EXPECT_NEAR(double{uniform_triangle_pdf()} * surface_jacobian(map, u), 1, 1e-3);
    const Vec2 back = invert_uniform_triangle(sample_uniform_triangle(u));
    EXPECT_NEAR(back.x, u.x, 1e-6f);
    EXPECT_NEAR(back.y, u.y, 1e-6f);
  }
}

struct Exponential {
  float sigma, t_max;
};

class ExponentialWarp : public testing::TestWithParam<Exponential> {};
INSTANTIATE_TEST_SUITE_P(Extremes, ExponentialWarp,
                         testing::Values(Exponential{2, infinity}, Exponential{2, 1},
                                         Exponential{1e-3f, 10}, Exponential{1e-6f, 1},
                                         Exponential{1e-8f, 1}, Exponential{0, 5},
                                         Exponential{50, 3}, Exponential{1e-20f, 1e20f},
                                         Exponential{1e-30f, infinity}));

TEST_P(ExponentialWarp, MatchesItsDensity) {
  const float sigma = GetParam().sigma, t_max = GetParam().t_max;
  const float end = std::min(t_max, 8 / sigma);
  // In units of the range, so that floats of any size are compared alike.
  const auto draw = [=](float u) { return sample_exponential(u, sigma, t_max) / end; };
  const auto pdf = [=](double x) {
    return double{exponential_pdf(static_cast<float>(x * double{end}), sigma, t_max)} *
           double{end};
  };
  const ChiSquareResult r = chi_square_line(draw, pdf, 0, 1);
  EXPECT_GT(r.p_value, sidak(0.01, 9)) << r;
  const double k = double{sigma} * double{end};
  EXPECT_NEAR(r.mass, end < t_max ? -std::expm1(-k) : 1, 1e-5);
  // Closed form of the mean distance below the end.
  const double mean = k < 1e-3 ? 0.5 - k / 12 : 1 / k - 1 / std::expm1(k);
  EXPECT_GT(z_p_value(r.moments[0], mean), sidak(0.01, 9));
}

TEST_P(ExponentialWarp, InverseUndoesSampleAndStaysInRange) {
  const auto [sigma, t_max] = GetParam();
  RandomStream random(3);
  for (int i = 0; i < 5000; ++i) {
    const float u = i == 0 ? 0 : i == 1 ? one_minus_epsilon : random.next_1d();
    const float t = sample_exponential(u, sigma, t_max);
    ASSERT_TRUE(t >= 0 && t <= t_max && std::isfinite(t));
    ASSERT_GT(exponential_pdf(t, sigma, t_max), 0);
    ASSERT_NEAR(invert_exponential(t, sigma, t_max), u, 5e-7f);
  }
}

TEST_P(ExponentialWarp, DensityIsTheInverseJacobian) {
  const float sigma = GetParam().sigma, t_max = GetParam().t_max;
  const auto map = [=](float u) { return sample_exponential(u, sigma, t_max); };
  for (const float u : {0.1f, 0.5f, 0.8f})
    EXPECT_NEAR(double{exponential_pdf(map(u), sigma, t_max)} * line_jacobian(map, u), 1,
                1e-3);
}

}  // namespace
}  // namespace tyndall
