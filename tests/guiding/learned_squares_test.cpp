// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/learned_squares.h"

#include <gtest/gtest.h>

#include <array>

#include "support/chi_square.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr size_t megabyte = 1 << 20;

// Only the lower left corner of square 1 is worth anything.
float worth(const SquaresSample& s) {
  return s.index == 1 && s.p.x < 0.25f && s.p.y < 0.5f ? 1 / s.density : 0;
}

void learn(LearnedSquares& squares, int samples, uint64_t key) {
  RandomStream random(key);
  for (int i = 0; i < samples; ++i) {
    const float u = random.next_1d();
    const SquaresSample s = squares.sample(u, random.next_2d());
    squares.record(s, worth(s));
  }
  squares.update();
}

double relative_variance(const LearnedSquares& squares) {
  RandomStream random(99);
  RunningMoments moments;
  for (int i = 0; i < 100'000; ++i) {
    const float u = random.next_1d();
    moments.add(static_cast<double>(worth(squares.sample(u, random.next_2d()))));
  }
  EXPECT_NEAR(moments.mean(), 0.125, 0.01);  // the worth is one over an eighth
  return moments.variance() / (moments.mean() * moments.mean());
}

TEST(LearnedSquaresTest, UntrainedFollowsTheWeights) {
  const std::array<float, 3> weights{1, 0, 3};
  const LearnedSquares squares(weights, megabyte);
  EXPECT_EQ(squares.density(0, {0.2f, 0.7f}), 0.25f);
  EXPECT_EQ(squares.density(1, {0.2f, 0.7f}), 0);
  EXPECT_EQ(squares.sample(0.1f, {0.3f, 0.6f}).index, 0u);
  EXPECT_EQ(squares.sample(0.5f, {0.3f, 0.6f}).index, 2u);
  EXPECT_EQ(squares.sample(0.5f, {0.3f, 0.6f}).p, (Vec2{0.3f, 0.6f}));
}

TEST(LearnedSquaresTest, VarianceFallsAndTheMeanStays) {
  const std::array<float, 2> weights{1, 1};
  LearnedSquares squares(weights, megabyte);
  EXPECT_NEAR(relative_variance(squares), 15, 0.5);  // found once in sixteen samples
  learn(squares, 50'000, 1);
  EXPECT_LT(relative_variance(squares), 0.5);
}

// As long as nothing was found in a part, it is sampled like the whole; then by what was.
TEST(LearnedSquaresTest, PartsStartFromTheWhole) {
  const std::array<float, 2> weights{1, 1};
  LearnedSquares whole(weights, megabyte);
  learn(whole, 50'000, 1);
  LearnedSquares part(weights, 8192);
  EXPECT_LT(part.resolution(), whole.resolution());
  part.update(whole);
  EXPECT_LT(relative_variance(part), 0.5);

  const auto elsewhere = [](const SquaresSample& s) {
    return s.index == 0 && s.p.x > 0.75f ? 1 / s.density : 0;
  };
  RandomStream random(2);
  for (int i = 0; i < 20'000; ++i) {
    const float u = random.next_1d();
    const SquaresSample s = part.sample(u, random.next_2d());
    part.record(s, elsewhere(s));
  }
  part.update(whole);
  EXPECT_GT(part.probability(0), 0.8f);
  EXPECT_GT(part.density(0, {0.9f, 0.5f}), 2.5f);
  EXPECT_GT(part.density(1, {0.1f, 0.2f}), 0);
}

TEST(LearnedSquaresTest, SamplesFollowTheirDensity) {
  const std::array<float, 2> weights{1, 1};
  LearnedSquares squares(weights, megabyte);
  learn(squares, 20'000, 2);
  // The second square, by the part of the unit interval that chooses it.
  const float share = squares.probability(0);
  const ChiSquareResult r = chi_square_square(
      [&](Vec2 u) {
        return std::optional(squares.sample(share + (1 - share) * 0.5f, u).p);
      },
      [&](Vec2 p) {
        return double{squares.density(1, p)} / double{squares.probability(1)};
      });
  EXPECT_GT(r.p_value, 0.01) << r;
  EXPECT_NEAR(r.mass, 1, 1e-4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
  EXPECT_LT(r.moments[0].mean(), 0.3);  // towards the corner, not away from it
  EXPECT_LT(r.moments[1].mean(), 0.4);
}

TEST(LearnedSquaresTest, SampleAndDensityAgree) {
  const std::array<float, 3> weights{1, 2, 3};
  LearnedSquares squares(weights, megabyte);
  learn(squares, 20'000, 3);
  RandomStream random(4);
  for (int i = 0; i < 10'000; ++i) {
    const float u = random.next_1d();
    const SquaresSample s = squares.sample(u, random.next_2d());
    EXPECT_FLOAT_EQ(s.density, squares.density(s.index, s.p));
    EXPECT_GT(s.density, 0);
  }
}

TEST(LearnedSquaresTest, WithoutFindsNothingChanges) {
  const std::array<float, 2> weights{1, 3};
  LearnedSquares squares(weights, megabyte);
  squares.update();
  EXPECT_EQ(squares.density(1, {0.5f, 0.5f}), 0.75f);
}

// Of each cell the moment and, once learned, two numbers; rows have tables of their own.
TEST(LearnedSquaresTest, MemoryHasTheTablesOfRows) {
  const std::array<float, 2> weights{1, 3};
  LearnedSquares squares(weights, megabyte);
  const auto rows =
      static_cast<size_t>(squares.squares()) * static_cast<size_t>(squares.resolution());
  const size_t cells = rows * static_cast<size_t>(squares.resolution());
  const size_t before = squares.memory();
  EXPECT_GE(before, cells * sizeof(int64_t));
  learn(squares, 1000, 1);
  EXPECT_GE(squares.memory() - before,
            2 * cells * sizeof(float) + rows * sizeof(PiecewiseConstant1D));
  EXPECT_LT(squares.memory() - before,
            3 * cells * sizeof(float) + rows * sizeof(PiecewiseConstant1D));
}

TEST(LearnedSquaresTest, ManySquaresGetFewerCells) {
  const std::vector<float> weights(100'000, 1.0f);
  LearnedSquares squares(weights, 4 * megabyte);
  EXPECT_EQ(squares.resolution(), 1);
  EXPECT_LE(squares.memory(), 4 * megabyte);
}

}  // namespace
}  // namespace tyndall
