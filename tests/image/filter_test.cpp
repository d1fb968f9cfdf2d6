// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "support/chi_square.h"
#include "support/statistical_tests.h"

namespace tyndall {
namespace {

struct NamedFilter {
  const char* name;
  FilterSettings settings;
};

class FilterTest : public testing::TestWithParam<NamedFilter> {
 protected:
  double radius_x() const { return static_cast<double>(GetParam().settings.radius.x); }
  double radius_y() const { return static_cast<double>(GetParam().settings.radius.y); }
  /// The integral of g(x) |f(x, y)| or, `with_sign`, of g(x) f(x, y); midpoint rule.
  double integral(const Filter& filter, bool with_sign, double (*g)(double)) const;
};

INSTANTIATE_TEST_SUITE_P(
    Kinds, FilterTest,
    testing::Values(NamedFilter{"box", {FilterKind::box, {0.5f, 0.5f}}},
                    NamedFilter{"triangle", {FilterKind::triangle, {2, 1.5f}}},
                    NamedFilter{"gaussian", {FilterKind::gaussian, {1.5f, 1.5f}, 0.5f}},
                    NamedFilter{"narrow_gaussian", {FilterKind::gaussian, {4, 3}, 0.2f}},
                    NamedFilter{"mitchell", {FilterKind::mitchell, {2, 2}}},
                    NamedFilter{"catmull_rom",
                                {FilterKind::mitchell, {2, 3}, 0.5f, 0, 0.5f}}),
    [](const auto& test) { return std::string(test.param.name); });

double one(double) { return 1; }
double square(double x) { return x * x; }

double FilterTest::integral(const Filter& filter, bool with_sign,
                            double (*g)(double)) const {
  const int n = 1000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double y = radius_y() * (2 * (i + 0.5) / n - 1);
    for (int j = 0; j < n; ++j) {
      const double x = radius_x() * (2 * (j + 0.5) / n - 1);
      const double f = filter.eval({static_cast<float>(x), static_cast<float>(y)});
      sum += g(x) * (with_sign ? f : std::abs(f));
    }
  }
  return sum * 4 * radius_x() * radius_y() / (static_cast<double>(n) * n);
}

TEST_P(FilterTest, SamplesFollowTheMagnitude) {
  const Filter filter(GetParam().settings);
  const double norm = 4 * radius_x() * radius_y() / integral(filter, false, one);
  const auto offset = [&](Vec2 p) {
    return Vec2{static_cast<float>(radius_x()) * (2 * p.x - 1),
                static_cast<float>(radius_y()) * (2 * p.y - 1)};
  };
  const ChiSquareResult r = chi_square_square(
      [&](Vec2 u) {
        const Vec2 o = filter.sample(u).offset;
        return Vec2{(o.x / static_cast<float>(radius_x()) + 1) / 2,
                    (o.y / static_cast<float>(radius_y()) + 1) / 2};
      },
      [&](Vec2 p) { return norm * std::abs(static_cast<double>(filter.eval(offset(p)))); });
  EXPECT_GT(r.p_value, sidak(0.01, 6)) << r;
  EXPECT_NEAR(r.mass, 1, 1e-4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
}

/// Means of sign, sign * offset and sign * offset^2 over one axis, the other at its middle,
/// where every filter is positive. A regular grid of random numbers leaves only the tables'
/// error.
struct AxisMoments {
  double sign = 0, first = 0, second = 0;
};

AxisMoments axis_moments(const Filter& filter, bool along_x) {
  AxisMoments m;
  const int n = 1 << 19;
  for (int i = 0; i < n; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / n;
    const FilterSample s = filter.sample(along_x ? Vec2{u, 0.5f} : Vec2{0.5f, u});
    const double offset = static_cast<double>(along_x ? s.offset.x : s.offset.y);
    const double sign = (s.weight < 0 ? -1.0 : 1.0) / n;
    m.sign += sign;
    m.first += sign * offset;
    m.second += sign * offset * offset;
  }
  return m;
}

TEST_P(FilterTest, WeightedMomentsAreTheFilters) {
  const Filter filter(GetParam().settings);
  const AxisMoments x = axis_moments(filter, true), y = axis_moments(filter, false);
  const double weight = std::abs(static_cast<double>(filter.sample({0.5f, 0.5f}).weight));
  EXPECT_NEAR(weight * x.sign * y.sign, 1, 1e-5);
  EXPECT_NEAR(x.first, 0, 1e-5);
  EXPECT_NEAR(y.first, 0, 1e-5);
  const double expected = integral(filter, true, square) / integral(filter, true, one);
  EXPECT_NEAR(x.second / x.sign, expected, 1e-4 * radius_x() * radius_x());
}

TEST_P(FilterTest, WeightHasTheSignOfTheFilter) {
  const Filter filter(GetParam().settings);
  int wrong = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec2 u{std::fmod(static_cast<float>(i) * 0.618034f, 1.0f),
                 (static_cast<float>(i) + 0.5f) / 10000};
    const FilterSample s = filter.sample(u);
    const float f = filter.eval(s.offset);
    // Within a bin of a zero of f, |f| is below 2e-3 and the sign is the bin's.
    if (std::abs(f) > 2e-3f && (f < 0) != (s.weight < 0)) ++wrong;
    EXPECT_FLOAT_EQ(std::abs(s.weight), std::abs(filter.sample({0.5f, 0.5f}).weight));
  }
  EXPECT_EQ(wrong, 0);
}

TEST(FilterValueTest, GaussianEndsAtZero) {
  const Filter filter({FilterKind::gaussian, {1.5f, 1.5f}, 0.5f});
  EXPECT_EQ(filter.eval({1.5f, 0}), 0);
  EXPECT_EQ(filter.eval({1.6f, 0}), 0);
  const double at_radius = std::exp(-4.5);  // (1.5 / 0.5)^2 / 2
  EXPECT_NEAR(filter.eval({0.5f, 0}), (std::exp(-0.5) - at_radius) * (1 - at_radius), 1e-7);
}

// [Mitchell88]: for b = c = 1/3, k(0) = (6 - 2b) / 6 and k(1) = b / 6.
TEST(FilterValueTest, MitchellHasThePublishedValues) {
  const Filter filter({FilterKind::mitchell, {2, 2}});
  EXPECT_NEAR(filter.eval({0, 0}), 64.0 / 81, 1e-6);
  EXPECT_NEAR(filter.eval({1, 0}), 1.0 / 18 * 8 / 9, 1e-6);
  EXPECT_LT(filter.eval({1.5f, 0}), 0);
  EXPECT_EQ(filter.eval({2, 0}), 0);
}

TEST(FilterValueTest, PositiveFiltersHaveUnitWeight) {
  for (FilterKind kind : {FilterKind::box, FilterKind::triangle, FilterKind::gaussian}) {
    EXPECT_EQ(Filter({kind, {2, 2}}).sample({0.1f, 0.9f}).weight, 1);
  }
}

// The density is what eval() is, made to integrate to one.
TEST_P(FilterTest, DensityFollowsTheFilter) {
  const Filter filter(GetParam().settings);
  const double norm = integral(filter, true, one);
  double largest = double{filter.eval({0, 0})} / norm;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u{(static_cast<float>(i % 50) + 0.5f) / 50,
                 (static_cast<float>(i / 50) + 0.5f) / 40};
    const Vec2 p{GetParam().settings.radius.x * (2.2f * u.x - 1.1f),
                 GetParam().settings.radius.y * (2.2f * u.y - 1.1f)};
    EXPECT_NEAR(filter.density(p), double{filter.eval(p)} / norm, 0.01 * largest);
  }
}

}  // namespace
}  // namespace tyndall
