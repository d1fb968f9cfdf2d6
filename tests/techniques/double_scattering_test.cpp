// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "support/chi_square.h"
#include "support/quadrature.h"
#include "techniques/references.h"
#include "techniques/technique_checks.h"
#include "tyndall/techniques/binned_distance.h"
#include "tyndall/techniques/double_scattering_direction.h"
#include "tyndall/techniques/double_scattering_distance.h"

namespace tyndall {
namespace {

static_assert(DistanceTechnique<DoubleScatteringDistance>);

const ScatteringTables isotropic(0);

TEST(DoubleScatteringDistance, IsTheInverseDistanceInIsotropicMedia) {
  for (const Geometry& geometry : geometries()) {
    if (geometry.t_max == infinity) continue;
    SCOPED_TRACE(geometry.name);
    const DoubleScatteringDistance technique(isotropic, geometry.ray(), geometry.pivot(),
                                             geometry.t_min, geometry.t_max);
    const auto integral = [&](double t) {
      const double s = geometry.s(t);
      if (geometry.h == 0) return std::copysign(std::log(std::abs(s)), s);
      return std::asinh(s / geometry.h);
    };
    const double begin = integral(geometry.t_min), all = integral(geometry.t_max) - begin;
    EXPECT_NEAR(technique.integral() / all, 1, 1e-5);
    expect_follows(
        geometry, technique, [&](double t) { return 1 / (all * geometry.r(t)); },
        [&](double t) { return (integral(t) - begin) / all; }, 3e-6);
    expect_round_trip(technique, 3e-6);
  }
}

TEST(DoubleScatteringDistance, TapsAreItsSamples) {
  for (const Geometry& geometry : geometries()) {
    if (geometry.t_max == infinity) continue;
    const DoubleScatteringDistance technique(isotropic, geometry.ray(), geometry.pivot(),
                                             geometry.t_min, geometry.t_max);
    expect_taps_are_samples(geometry, technique);
  }
}

TEST(DoubleScatteringDistance, IsEmptyWithoutAnEnd) {
  EXPECT_FALSE(
      DoubleScatteringDistance(isotropic, {{0, 0, 0}, {0, 0, 1}}, {1, 0, 2}, 0, infinity)
          .sample(0.5f));
}

constexpr float asymmetries[] = {-0.9f, -0.3f, 0.0f, 1e-4f, 0.5f, 0.9f, 0.95f, 0.99f};
constexpr int tests = std::size(asymmetries);

class DoubleScatteringTest : public testing::TestWithParam<float> {
 protected:
  const float g = GetParam();
  const ScatteringTables tables{g};
};
INSTANTIATE_TEST_SUITE_P(Asymmetry, DoubleScatteringTest, testing::ValuesIn(asymmetries));

TEST_P(DoubleScatteringTest, TablesAreSmall) {
  EXPECT_LE(tables.size(), 100'000u);
  EXPECT_EQ(tables.size() == 0, g == 0);
}

TEST_P(DoubleScatteringTest, DistanceFollowsTheLightScatteredTwice) {
  for (const Geometry& geometry : geometries()) {
    if (geometry.t_max == infinity) continue;
    SCOPED_TRACE(geometry.name);
    const DoubleScatteringDistance technique(tables, geometry.ray(), geometry.pivot(),
                                             geometry.t_min, geometry.t_max);
    expect_round_trip(technique, 6e-6);
    const double sine = std::sin(geometry.alpha(geometry.t_min));
    if (sine < 0.05 || g == 1e-4f)
      continue;  // the reference takes long where its peaks merge
    const auto unnormalized = [&](double t) {
      return scattered_twice(g, geometry.alpha(t), M_PI) / geometry.r(t);
    };
    const float near = technique.sample(0.1f)->t, far = technique.sample(0.8f)->t;
    const double expected = unnormalized(near) / unnormalized(far);
    EXPECT_NEAR(technique.pdf_t(near) / technique.pdf_t(far) / expected, 1,
                (g > 0.95f ? 6e-4 : 3e-4) + position_error(geometry, near) +
                    position_error(geometry, far));
  }
  const Geometry beside{"beside", 1, 2, 0, 5};
  const DoubleScatteringDistance technique(tables, beside.ray(), beside.pivot(), 0, 5);
  const double mass = quadrature(
      [&](double t) { return double{technique.pdf_t(static_cast<float>(t))}; }, 0, 5, 1e-5);
  EXPECT_NEAR(mass, 1, 1e-4);
  expect_inverse_jacobian(technique, 2e-3);
}

/// Where directions are tested, about a pivot on the z axis.
struct Place {
  const char* name;
  Vec3 w_ab;
};
const Place places[] = {{"to the pivot", {0, 0, 1}},
                        {"away", {0, 0, -1}},
                        {"across", {1, 0, 0}},
                        {"nearly to the pivot", {0.1f, 0.05f, 0.9937f}},
                        {"askew", {0.48f, -0.6f, 0.64f}}};
const Vec3 b{0.3f, -0.2f, 0.1f};
const Vec3 pivot = b + Vec3{0, 0, 2};

double polar_angle(Vec3 w) { return std::atan2(std::hypot(w.x, w.y), double(w.z)); }

/// Light scattered by a first vertex at b into w_ab that reached it against direction w.
double scattered_along(double g, Vec3 w_ab, Vec3 w) {
  const double theta = polar_angle(w);
  const double cosine = double(w_ab.x) * w.x + double(w_ab.y) * w.y + double(w_ab.z) * w.z;
  const double norm = std::sqrt(double(length_squared(w_ab)) * length_squared(w));
  return henyey_greenstein(g, std::clamp(cosine / norm, -1.0, 1.0)) *
         (arc(g, M_PI) - arc(g, theta)) / std::sin(theta);
}

/// The relative variance that tables may leave in the worst place tested.
double table_variance(double g) {
  return std::abs(g) <= 0.5 ? 1e-5 : std::abs(g) <= 0.9 ? 2e-4 : g <= 0.95 ? 1e-3 : 0.1;
}

// If the quotient is constant, samples follow the integrand; and if it is the known
// integral of it, the density integrates to one over what is sampled.
TEST_P(DoubleScatteringTest, DirectionsFollowTheLight) {
  for (const Place& place : places) {
    SCOPED_TRACE(place.name);
    const Vec3 w_ab = normalize(place.w_ab);
    const DoubleScatteringDirection technique(tables, b, w_ab, pivot);
    RandomStream random(3);
    RunningMoments weights;
    for (int i = 0; i < 4000; ++i) {
      const auto sample = technique.sample(random.next_2d());
      ASSERT_TRUE(sample.has_value());
      weights.add(scattered_along(g, w_ab, sample->w) / sample->pdf);
    }
    const double expected = scattered_twice(g, polar_angle(w_ab), M_PI);
    EXPECT_LT(weights.variance() / sqr(expected), table_variance(g));
    EXPECT_NEAR(weights.mean() / expected, 1, 3 * std::sqrt(table_variance(g) / 4000));
  }
}

TEST_P(DoubleScatteringTest, DirectionsInvert) {
  RandomStream random(2);
  for (const Place& place : places) {
    SCOPED_TRACE(place.name);
    const DoubleScatteringDirection technique(tables, b, normalize(place.w_ab), pivot);
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u = random.next_2d();
      const auto sample = technique.sample(u);
      ASSERT_TRUE(sample.has_value());
      // A direction is known to a few 1e-7, an azimuth to that over the sine; peaks are as
      // wide as 1 - |g|.
      const float sine = length(cross(sample->w, {0, 0, 1}));
      const float width = 1 - std::abs(g);
      EXPECT_NEAR(technique.pdf(sample->w) / sample->pdf, 1, 2e-6 + 1e-6 / sine / width);
      const Vec2 back = technique.invert(sample->w);
      EXPECT_NEAR(back.x, u.x, 4e-6f + 1e-6f * sine * sample->pdf + 1e-7f / width) << u.y;
      const float around = std::abs(back.y - u.y);
      EXPECT_NEAR(std::min(around, 1 - around), 0, 4e-6f + 1e-6f / sine / width) << u.x;
    }
  }
}

TEST_P(DoubleScatteringTest, DirectionDensityIsTheInverseJacobian) {
  const float step = 1.0f / 1024;
  for (const Place& place : places) {
    SCOPED_TRACE(place.name);
    const DoubleScatteringDirection technique(tables, b, normalize(place.w_ab), pivot);
    RunningMoments error;
    for (float x = 0.03f; x < 0.97f; x += 0.067f)
      for (float y = 0.03f; y < 0.97f; y += 0.067f) {
        const auto at = [&](float dx, float dy) {
          return technique.sample({x + dx, y + dy})->w;
        };
        const Vec3 along_x = at(step, 0) - at(-step, 0),
                   along_y = at(0, step) - at(0, -step);
        const float area = length(cross(along_x, along_y)) / sqr(2 * step);
        error.add(area * technique.sample({x, y})->pdf - 1);
      }
    // Finite differences err by the curvature of the map, this way and that.
    EXPECT_NEAR(error.mean(), 0, 3e-3);
    EXPECT_LT(std::sqrt(error.variance()), 0.02);
  }
}

TEST_P(DoubleScatteringTest, DirectionsPassTheChiSquareTest) {
  if (std::abs(g) > 0.5f) return;  // peaks take the quadrature of the test too long
  const DoubleScatteringDirection technique(tables, b, normalize(places[4].w_ab), pivot);
  // Over angles the density is bounded: theta / pi, phi / (2 pi).
  const auto direction = [](Vec2 p) {
    const float theta = pi * p.x, phi = 2 * pi * p.y - pi;
    return Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                std::cos(theta)};
  };
  const ChiSquareResult result = chi_square_square(
      [&](Vec2 u) -> std::optional<Vec2> {
        const Vec3 w = technique.sample(u)->w;
        return Vec2{static_cast<float>(polar_angle(w)) / pi,
                    0.5f + std::atan2(w.y, w.x) / (2 * pi)};
      },
      [&](Vec2 p) {
        const float x = std::clamp(p.x, 1e-5f, 1 - 1e-5f);
        return double{technique.pdf(direction({x, p.y}))} * std::sin(M_PI * x) * 2 * M_PI *
               M_PI;
      },
      20'000, 1, 12);
  EXPECT_GT(result.p_value, sidak(0.01, tests)) << result;
  EXPECT_NEAR(result.mass, 1, 1e-3);
  EXPECT_EQ(result.samples_of_zero_pdf, 0);
}

// What a chi-square test cannot see: the sign of the azimuth's axis, and of the pole.
TEST_P(DoubleScatteringTest, DirectionsLeanTowardsTheRayAndThePivot) {
  const Vec3 w_ab = normalize(places[4].w_ab);
  const double alpha = polar_angle(w_ab);
  const DoubleScatteringDirection technique(tables, b, w_ab, pivot);
  RandomStream random(4);
  RunningMoments along;
  for (int i = 0; i < 20'000; ++i)
    along.add(std::cos(polar_angle(technique.sample(random.next_2d())->w)));
  const auto density = [&](double theta) {
    return 2 * azimuth_arc(g, alpha, theta, M_PI) * (arc(g, M_PI) - arc(g, theta));
  };
  const double peak = g > 0 ? alpha : M_PI - alpha;
  const auto first_moment = [&](double x) { return std::cos(x) * density(x); };
  const double expected = (quadrature(first_moment, 0, peak, 1e-7) +
                           quadrature(first_moment, peak, M_PI, 1e-7)) /
                          scattered_twice(g, alpha, M_PI);
  // By Cauchy and Schwarz, a density that misses the integrand by the tables' error has
  // moments off by no more than that in units of the standard deviation.
  const double tolerance =
      4 * along.standard_error() + std::sqrt(table_variance(g) * along.variance());
  EXPECT_NEAR(along.mean(), expected, tolerance);
}

TEST_P(DoubleScatteringTest, DirectionsWithoutPhaseFunctionFollowTheLight) {
  const DoubleScatteringDirection technique(tables, b, pivot);
  RandomStream random(5);
  RunningMoments weights, x;
  for (int i = 0; i < 4000; ++i) {
    const Vec2 u = random.next_2d();
    const auto sample = technique.sample(u);
    ASSERT_TRUE(sample.has_value());
    const double theta = polar_angle(sample->w);
    weights.add((arc(g, M_PI) - arc(g, theta)) / std::sin(theta) / sample->pdf);
    x.add(sample->w.x);
    const Vec2 back = technique.invert(sample->w);
    EXPECT_NEAR(back.x, u.x, 6e-6f + 1e-6f * std::sin(theta) * sample->pdf);
  }
  const double expected =
      2 * M_PI *
      quadrature([&](double theta) { return arc(g, M_PI) - arc(g, theta); }, 0, M_PI, 1e-8);
  EXPECT_LT(weights.variance() / sqr(expected), table_variance(g));
  EXPECT_NEAR(weights.mean() / expected, 1, 3 * std::sqrt(table_variance(g) / 4000));
  EXPECT_GT(z_p_value(x, 0), sidak(0.01, tests));
}

TEST(DoubleScatteringDirection, IsEmptyAtThePivot) {
  const ScatteringTables forward(0.5f);
  for (const ScatteringTables* tables : {&isotropic, &forward}) {
    const DoubleScatteringDirection technique(*tables, pivot, {0, 0, 1}, pivot);
    EXPECT_FALSE(technique.sample({0.5f, 0.5f}));
    EXPECT_EQ(technique.pdf({1, 0, 0}), 0);
  }
}

}  // namespace
}  // namespace tyndall
