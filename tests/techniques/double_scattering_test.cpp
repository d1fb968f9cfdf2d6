// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "techniques/technique_checks.h"
#include "tyndall/techniques/binned_distance.h"
#include "tyndall/techniques/double_scattering_direction.h"
#include "tyndall/techniques/double_scattering_distance.h"
#include "tyndall/techniques/single_scattering_distance.h"

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
    const auto taps = technique.taps<64>();
    for (int i = 0; i < 64; ++i) {
      const double t = technique.sample((static_cast<float>(i) + 0.5f) / 64)->t;
      const double tolerance = 1e-4 * geometry.r(t) + 4 * ulp(t) + 2 * ulp(geometry.foot);
      EXPECT_NEAR(taps.t[i], t, tolerance) << geometry << " " << i;
      EXPECT_NEAR(taps.distance[i], geometry.r(t), tolerance) << geometry << " " << i;
      EXPECT_NEAR(taps.cos_alpha[i], std::cos(geometry.alpha(t)),
                  1e-4 + tolerance / geometry.r(t))
          << geometry << " " << i;
    }
  }
}

TEST(DoubleScatteringDistance, IsEmptyWithoutAnEnd) {
  EXPECT_FALSE(
      DoubleScatteringDistance(isotropic, {{0, 0, 0}, {0, 0, 1}}, {1, 0, 2}, 0, infinity)
          .sample(0.5f));
}

constexpr float asymmetries[] = {-0.9f, -0.3f, 0.0f, 1e-4f, 0.5f, 0.9f, 0.95f, 0.99f};

class DoubleScatteringTest : public testing::TestWithParam<float> {
 protected:
  const float g = GetParam();
  const ScatteringTables tables{g};
};
INSTANTIATE_TEST_SUITE_P(Asymmetry, DoubleScatteringTest, testing::ValuesIn(asymmetries));

/// Where directions are tested: beside, ahead and behind the pivot.
struct Place {
  Vec3 w_ab;
  const char* name;
};
const Place places[] = {{{0, 0, 1}, "to the pivot"},
                        {{0, 0, -1}, "away"},
                        {{1, 0, 0}, "across"},
                        {{0.1f, 0.05f, 0.9937f}, "nearly to the pivot"},
                        {{0.48f, -0.6f, 0.64f}, "askew"}};
const Vec3 b{0.3f, -0.2f, 0.1f};
const Vec3 pivot = b + Vec3{0, 0, 2};

TEST_P(DoubleScatteringTest, DirectionsInvert) {
  RandomStream random(2);
  for (const Place& place : places) {
    SCOPED_TRACE(place.name);
    const DoubleScatteringDirection technique(tables, b, normalize(place.w_ab), pivot);
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u = random.next_2d();
      const auto sample = technique.sample(u);
      ASSERT_TRUE(sample.has_value());
      EXPECT_FLOAT_EQ(sample->pdf, technique.pdf(sample->w));
      const Vec2 back = technique.invert(sample->w);
      // A direction is known to a few 1e-7, an azimuth to that over the sine.
      const float sine = length(cross(sample->w, {0, 0, 1}));
      const float tolerance = 4e-6f + 1e-6f * sine * sample->pdf + 1e-7f / (1 - std::abs(g));
      EXPECT_NEAR(back.x, u.x, tolerance) << u.y;
      const float around = std::abs(back.y - u.y);
      EXPECT_NEAR(std::min(around, 1 - around), 0,
                  4e-6f + 1e-6f / sine / (1 - std::abs(g))) << u.x;
    }
  }
}

}  // namespace
}  // namespace tyndall
