// SPDX-License-Identifier: Apache-2.0
#include "tyndall/sampling/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "support/chi_square.h"

namespace tyndall {
namespace {

class BothSamplers : public testing::TestWithParam<SamplerKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, BothSamplers,
                         testing::Values(SamplerKind::independent, SamplerKind::sobol));

// The pair number `dimension` of samples first, first + 1, ... of one pixel.
std::vector<Vec2> pairs(SamplerKind kind, uint64_t seed, uint32_t first, int count,
                        int dimension) {
  std::vector<Vec2> points;
  for (uint32_t i = first; points.size() < static_cast<size_t>(count); ++i) {
    Sampler sampler(kind, seed, {3, 4}, i);
    for (int d = 0; d < dimension; ++d) sampler.next_2d();
    points.push_back(sampler.next_2d());
  }
  return points;
}

// The squared L2 star discrepancy, by Warnock's formula.
double discrepancy(const std::vector<Vec2>& points) {
  const auto n = static_cast<double>(points.size());
  double singles = 0, doubles = 0;
  for (const Vec2& p : points) {
    singles += (1 - double{p.x} * double{p.x}) * (1 - double{p.y} * double{p.y});
    for (const Vec2& q : points)
      doubles += (1 - double{std::max(p.x, q.x)}) * (1 - double{std::max(p.y, q.y)});
  }
  return 1.0 / 9 - singles / (2 * n) + doubles / (n * n);
}

TEST_P(BothSamplers, IsAFunctionOfItsArguments) {
  Sampler a(GetParam(), 5, {10, 20}, 77), b(GetParam(), 5, {10, 20}, 77);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(a.next_1d(), b.next_1d());
    EXPECT_EQ(a.next_2d(), b.next_2d());
    EXPECT_EQ(a.fork().next_bits(), b.fork().next_bits());
  }
}

TEST_P(BothSamplers, EveryArgumentMatters) {
  const Vec2 u = Sampler(GetParam(), 5, {10, 20}, 77).next_2d();
  EXPECT_NE(u, Sampler(GetParam(), 6, {10, 20}, 77).next_2d());
  EXPECT_NE(u, Sampler(GetParam(), 5, {11, 20}, 77).next_2d());
  EXPECT_NE(u, Sampler(GetParam(), 5, {10, 21}, 77).next_2d());
  EXPECT_NE(u, Sampler(GetParam(), 5, {10, 20}, 78).next_2d());
  EXPECT_NE(u, Sampler(GetParam(), 5, {20, 10}, 77).next_2d());
}

TEST_P(BothSamplers, BlocksDoNotDependOnWhatWasDrawnBefore) {
  Sampler a(GetParam(), 5, {10, 20}, 77), b = a, c = a;
  b.next_2d();
  b.start_block(3);
  a.start_block(3);
  c.start_block(4);
  const Vec2 u = a.next_2d();
  EXPECT_EQ(u, b.next_2d());
  EXPECT_NE(u, c.next_2d());
  EXPECT_EQ(a.next_1d(), b.next_1d());
}

TEST(Sampler, BlocksKeepTheSamplesOfAPixelWellDistributed) {
  const auto strata = [](bool in_block) {
    std::set<int> met;
    for (uint32_t i = 0; i < 64; ++i) {
      Sampler sampler(SamplerKind::sobol, 5, {10, 20}, i);
      for (uint32_t k = 0; k < i % 3; ++k) sampler.next_1d();
      if (in_block) sampler.start_block(1);
      met.insert(static_cast<int>(sampler.next_1d() * 64));
    }
    return met.size();
  };
  EXPECT_EQ(strata(true), 64);
  EXPECT_LT(strata(false), 60);
}

TEST_P(BothSamplers, StaysInTheHalfOpenInterval) {
  for (uint32_t i = 0; i < 2000; ++i) {
    Sampler sampler(GetParam(), 1, {-5, 1 << 20}, i * 2147483u);
    for (int d = 0; d < 8; ++d) {
      const Vec2 p = sampler.next_2d();
      EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
      const float x = sampler.next_1d();
      EXPECT_TRUE(x >= 0 && x < 1);
    }
  }
}

// Each number of each sample must be uniform over scrambles, or estimates would be biased.
TEST_P(BothSamplers, EverySampleIsUniformOverPixels) {
  for (const uint32_t index : {0u, 1u, 63u, 4'000'000'000u})
    for (int dimension = 0; dimension < 3; ++dimension) {
      int pixel = 0;
      const auto draw = [&](Vec2) {
        ++pixel;
        Sampler sampler(GetParam(), 9, {pixel % 512, pixel / 512}, index);
        for (int d = 0; d < dimension; ++d) sampler.next_2d();
        return sampler.next_2d();
      };
      const ChiSquareResult r = chi_square_square(
          draw, [](Vec2) { return 1.0; }, 40'000, 1, 16);
      EXPECT_GT(r.p_value, sidak(0.01, 24)) << r;
      EXPECT_GT(z_p_value(r.moments[0], 0.5), sidak(0.01, 24));
      EXPECT_GT(z_p_value(r.moments[1], 0.5), sidak(0.01, 24));
    }
}

TEST_P(BothSamplers, DimensionsAreUncorrelatedOverSamplesOfAPixel) {
  const int n = 1 << 14;
  const std::vector<Vec2> first = pairs(GetParam(), 2, 0, n, 0);
  for (int dimension = 1; dimension < 6; ++dimension) {
    const std::vector<Vec2> other = pairs(GetParam(), 2, 0, n, dimension);
    for (const auto component : {&Vec2::x, &Vec2::y}) {
      size_t i = 0;
      const auto draw = [&](Vec2) {
        const Vec2 point{first[i].x, other[i].*component};
        ++i;
        return point;
      };
      const ChiSquareResult r = chi_square_square(
          draw, [](Vec2) { return 1.0; }, n, 1, 8);
      EXPECT_GT(r.p_value, sidak(0.01, 20)) << r;
    }
  }
}

TEST_P(BothSamplers, ForksAreUniformAndIndependentOfAllElse) {
  RunningMoments with_dimension, with_other_fork, with_next_sample;
  std::vector<double> values;
  for (uint32_t i = 0; i < 20'000; ++i) {
    Sampler sampler(GetParam(), 3, {1, 1}, i), next(GetParam(), 3, {1, 1}, i + 1);
    next.next_1d();
    const double u = double{sampler.next_1d()} - 0.5;
    const double a = double{sampler.fork().next_1d()} - 0.5;
    const double b = double{sampler.fork().next_1d()} - 0.5;
    const double c = double{next.fork().next_1d()} - 0.5;
    values.push_back(a + 0.5);
    with_dimension.add(u * a);
    with_other_fork.add(a * b);
    with_next_sample.add(a * c);
  }
  EXPECT_GT(uniformity_p_value(values), 0.002);
  EXPECT_GT(z_p_value(with_dimension, 0), 0.002);
  EXPECT_GT(z_p_value(with_other_fork, 0), 0.002);
  EXPECT_GT(z_p_value(with_next_sample, 0), 0.002);
}

// Aligned blocks of 2^m samples are (0, m, 2)-nets: every box of 2^-a by 2^(a - m) with
// corners at multiples of its sides holds exactly one point.
TEST(Sobol, PairsFormNets) {
  for (const int m : {1, 4, 8, 11})
    for (const uint32_t block : {0u, 5u, 1000u})
      for (const int dimension : {0, 1, 7}) {
        const int n = 1 << m;
        const std::vector<Vec2> points =
            pairs(SamplerKind::sobol, 4, block * static_cast<uint32_t>(n), n, dimension);
        for (int a = 0; a <= m; ++a) {
          std::set<int> boxes;
          for (const Vec2& p : points)
            boxes.insert(static_cast<int>(std::ldexp(p.x, a)) * n +
                         static_cast<int>(std::ldexp(p.y, m - a)));
          ASSERT_EQ(boxes.size(), static_cast<size_t>(n)) << m << " " << block << " " << a;
        }
      }
}

TEST(Sobol, SinglesAreStratified) {
  std::set<int> strata;
  for (uint32_t i = 0; i < 256; ++i) {
    Sampler sampler(SamplerKind::sobol, 8, {0, 0}, i);
    sampler.next_2d();
    strata.insert(static_cast<int>(sampler.next_1d() * 256));
  }
  EXPECT_EQ(strata.size(), 256u);
}

TEST(Sobol, HasLessDiscrepancyThanRandomPoints) {
  for (const int n : {64, 100, 1024}) {
    const double sobol = discrepancy(pairs(SamplerKind::sobol, 1, 0, n, 2));
    const double random = discrepancy(pairs(SamplerKind::independent, 1, 0, n, 2));
    EXPECT_LT(sobol, random / (n < 1000 ? 3 : 30)) << n;
  }
}

// Owen scrambling integrates smooth functions with a variance of about n^-3.
TEST(Sobol, IntegratesSmoothFunctionsFaster) {
  const auto error = [](SamplerKind kind, int n) {
    RunningMoments squares;
    for (uint64_t seed = 0; seed < 64; ++seed) {
      double sum = 0;
      for (const Vec2& p : pairs(kind, seed, 0, n, 1))
        sum += std::sin(double{p.x} + 2 * double{p.y}) * std::exp(double{p.x});
      // The integral over the square, from the antiderivatives in x and y.
      const auto inner = [](double shift) {
        const auto F = [&](double x) {
          return 0.5 * std::exp(x) * (std::cos(x + shift) + std::sin(x + shift));
        };
        return 0.5 * (F(1) - F(0));
      };
      const double exact = inner(0) - inner(2);
      squares.add((sum / n - exact) * (sum / n - exact));
    }
    return squares.mean();
  };
  EXPECT_LT(error(SamplerKind::sobol, 256), error(SamplerKind::independent, 256) / 1000);
  EXPECT_LT(error(SamplerKind::sobol, 1024), error(SamplerKind::sobol, 64) / 1000);
}

TEST(Sampler, SkipsNumbersWithoutChangingLaterOnes) {
  for (const SamplerKind kind : {SamplerKind::independent, SamplerKind::sobol}) {
    Sampler all(kind, 7, {3, 4}, 5), some(kind, 7, {3, 4}, 5);
    all.next_2d();
    some.skip();
    const float next = all.next_1d();
    EXPECT_EQ(some.next_1d(), next);
    EXPECT_NE(Sampler(kind, 7, {3, 4}, 5).next_1d(), next);
  }
}

}  // namespace
}  // namespace tyndall
