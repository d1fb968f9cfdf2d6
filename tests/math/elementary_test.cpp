// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tyndall {
namespace {

/// Calls f with every 97th float from low to high, the two included.
template <typename F>
void for_floats(float low, float high, const F& f) {
  const auto end = std::bit_cast<uint32_t>(high);
  for (auto bits = std::bit_cast<uint32_t>(low); bits < end; bits += 97)
    f(std::bit_cast<float>(bits));
  f(high);
}

/// The largest error of f against `exact` in double, relative to its size.
template <typename F, typename Exact>
double relative_error(float low, float high, const F& f, const Exact& exact) {
  double worst = 0;
  for_floats(low, high, [&](float x) {
    const double expected = exact(double{x});
    worst = std::max(worst, std::abs(double{f(x)} - expected) / std::abs(expected));
  });
  return worst;
}

constexpr float tiny = std::numeric_limits<float>::min();

TEST(Elementary, ArcTangent) {
  EXPECT_EQ(arc_tangent_over(0), 1);
  EXPECT_LT(
      relative_error(tiny, 1, arc_tangent_over, [](double x) { return std::atan(x) / x; }),
      1.5e-7);
}

TEST(Elementary, ArcTangentHasTheSignOfItsArgument) {
  EXPECT_EQ(arc_tangent(0), 0);
  for (const float x : {tiny, 0.3f, 1.0f}) {
    EXPECT_NEAR(arc_tangent(x) / std::atan(x), 1, 2e-7);
    EXPECT_EQ(arc_tangent(-x), -arc_tangent(x));
  }
}

/// The larger of the errors of both angles, each relative to its size.
double polar_angle_error(float run, float rise) {
  const PolarAngle found = polar_angle(run, rise);
  const double theta = std::atan2(double{rise}, double{run});
  const double back = std::atan2(double{rise}, -double{run});
  return std::max(std::abs(found.theta / theta - 1), std::abs(found.back / back - 1));
}

TEST(Elementary, PolarAngleInEachOctant) {
  double worst = 0;
  for_floats(1e-20f, 1, [&](float slope) {
    worst = std::max({worst, polar_angle_error(1, slope), polar_angle_error(slope, 1),
                      polar_angle_error(-slope, 1), polar_angle_error(-1, slope)});
  });
  for (const float length : {1e-15f, 1e15f})
    worst = std::max(worst, polar_angle_error(-length, 0.3f * length));
  EXPECT_LT(worst, 2.5e-7);
}

TEST(Elementary, PolarAngleOnTheAxis) {
  for (const float run : {0.0f, 1.0f, -1.0f}) {
    const PolarAngle found = polar_angle(run, 0);
    EXPECT_EQ(found.theta, run < 0 ? pi : 0);
    EXPECT_EQ(found.back, run < 0 ? 0 : pi);
  }
}

TEST(Elementary, SineAndCosineByTheSquare) {
  constexpr float quarter = 2.467401f;  // (pi / 2)^2
  EXPECT_EQ(sine_over(0), 1);
  EXPECT_LT(relative_error(tiny, quarter, sine_over,
                           [](double a) { return std::sin(std::sqrt(a)) / std::sqrt(a); }),
            1.5e-7);
  double worst = 0;
  for_floats(0, quarter, [&](float a) {
    worst = std::max(worst, std::abs(cosine_by_square(a) - std::cos(std::sqrt(double{a}))));
  });
  EXPECT_LT(worst, 1.5e-7);
}

TEST(Elementary, SineAndCosineOfTurns) {
  double worst = 0, worst_small = 0;
  for_floats(0, 1, [&](float x) {
    const SineCosine found = sine_cosine_of_turns(x);
    const double angle = 2 * M_PI * x;
    worst = std::max({worst, std::abs(found.sine - std::sin(angle)),
                      std::abs(found.cosine - std::cos(angle))});
    if (x > tiny && x < 0.125f)
      worst_small = std::max(worst_small, std::abs(found.sine / std::sin(angle) - 1));
  });
  EXPECT_LT(worst, 1.2e-7);
  EXPECT_LT(worst_small, 2e-7);
}

TEST(Elementary, Exponential) {
  EXPECT_EQ(exp_minus_1(0), 0);
  EXPECT_LT(
      relative_error(tiny, 88.7f, exp_minus_1, [](double x) { return std::expm1(x); }),
      2e-7);
}

TEST(Elementary, Logarithms) {
  constexpr float largest = std::numeric_limits<float>::max();
  EXPECT_EQ(log_of_1_plus(0), 0);
  EXPECT_LT(
      relative_error(tiny, largest, log_of_1_plus, [](double x) { return std::log1p(x); }),
      2.5e-7);
  EXPECT_EQ(log_of(1), 0);
  const auto exact = [](double x) { return std::log(x); };
  EXPECT_LT(relative_error(tiny, std::nextafter(1.0f, 0.0f), log_of, exact), 2.5e-7);
  EXPECT_LT(relative_error(std::nextafter(1.0f, 2.0f), largest, log_of, exact), 2.5e-7);
}

}  // namespace
}  // namespace tyndall
