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

double one(double) {
  return 1;
}
double square(double x) {
  return x * x;
}

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

// Over a regular grid of random numbers, so that only the tables' resolution is left.
TEST_P(FilterTest, WeightedMomentsAreTheFilters) {
  const Filter filter(GetParam().settings);
  const int n = 2000;
  double mean_weight = 0, mean_x = 0, mean_y = 0, mean_square_x = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const FilterSample s = filter.sample(
          {(static_cast<float>(j) + 0.5f) / n, (static_cast<float>(i) + 0.5f) / n});
      const double weight = static_cast<double>(s.weight) / (static_cast<double>(n) * n);
      mean_weight += weight;
      mean_x += weight * static_cast<double>(s.offset.x);
      mean_y += weight * static_cast<double>(s.offset.y);
      mean_square_x += weight * square(static_cast<double>(s.offset.x));
    }
  }
  const double expected = integral(filter, true, square) / integral(filter, true, one);
  EXPECT_NEAR(mean_weight, 1, 1e-3);
  EXPECT_NEAR(mean_x, 0, 1e-3);
  EXPECT_NEAR(mean_y, 0, 1e-3);
  EXPECT_NEAR(mean_square_x, expected, 2e-3 * radius_x() * radius_x());
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

}  // namespace
}  // namespace tyndall
