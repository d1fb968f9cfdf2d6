// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/transmittance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "media/random_media.h"
#include "support/statistical_tests.h"
#include "tyndall/media/ray_marching.h"

namespace tyndall {
namespace {

const Bounds3 box{{-1, 0, 2}, {1, 3, 2.5f}};
constexpr TransmittanceMethod methods[] = {TransmittanceMethod::ratio_tracking,
                                           TransmittanceMethod::residual_ratio_tracking,
                                           TransmittanceMethod::ray_marching};

Rgb exact_transmittance(const DensityGrid& grid, const Transform& world_from_medium,
                        const Ray& ray, float t_max, Rgb sigma_t) {
  const double depth =
      reference_optical_depth(grid, box, world_from_medium, ray, double{t_max});
  const auto transmittance = [&](float sigma) {
    return static_cast<float>(std::exp(-double{sigma} * depth));
  };
  return {transmittance(sigma_t.r), transmittance(sigma_t.g), transmittance(sigma_t.b)};
}

class TransmittanceCases
    : public testing::TestWithParam<std::tuple<TransmittanceMethod, Placement, RayStart>> {
 protected:
  TransmittanceMethod method() const { return std::get<0>(GetParam()); }
  Placement placement() const { return std::get<1>(GetParam()); }
  RayStart start() const { return std::get<2>(GetParam()); }
};

constexpr int case_count = 3 * 7 * 4;
INSTANTIATE_TEST_SUITE_P(All, TransmittanceCases,
                         testing::Combine(testing::ValuesIn(methods),
                                          testing::ValuesIn(all_placements),
                                          testing::ValuesIn(all_ray_starts)));

// Coloured, with one channel that nothing absorbs or scatters.
TEST_P(TransmittanceCases, IsUnbiased) {
  RandomStream rng(hash(1, method(), placement(), start()));
  RunningMoments error[3], value[3];
  for (const GridContent content :
       {GridContent::uniform_noise, GridContent::mostly_empty}) {
    const DensityGrid grid = random_grid(rng, {37, 22, 9}, content);
    const Transform world_from_medium = random_transform(rng, placement());
    const float size = length(world_from_medium.bounds(box).diagonal());
    const float sigma = (content == GridContent::mostly_empty ? 40.0f : 4.0f) / size;
    const Rgb sigma_t{sigma, 0.3f * sigma, 0};
    const Medium medium(GridMedium(grid, box, world_from_medium,
                                   {0.25f * sigma_t, 0.75f * sigma_t, {}},
                                   IsotropicPhase{}));
    for (int i = 0; i < 20; ++i) {
      const Ray ray = random_ray(rng, start(), box, world_from_medium);
      const float t_max = uniform(rng, 0.2f, 2) * size;
      const Rgb exact = exact_transmittance(grid, world_from_medium, ray, t_max, sigma_t);
      for (int k = 0; k < 300; ++k) {
        const Rgb estimate = estimate_transmittance(medium, ray, t_max, rng, method());
        for (int c = 0; c < 3; ++c)
          error[c].add(double{estimate[c]} - double{exact[c]}),
              value[c].add(double{exact[c]});
      }
    }
  }
  EXPECT_GT(z_p_value(error[0], 0), sidak(0.01, 2 * case_count))
      << error[0].mean() << " +- " << error[0].standard_error() << " of "
      << value[0].mean();
  EXPECT_GT(z_p_value(error[1], 0), sidak(0.01, 2 * case_count))
      << error[1].mean() << " +- " << error[1].standard_error() << " of "
      << value[1].mean();
  EXPECT_EQ(error[2].mean(), 0);
  EXPECT_EQ(error[2].variance(), 0);
}

// Grey media take a shorter way, and deep ones end walks by chance.
TEST_P(TransmittanceCases, IsUnbiasedInGreyMedia) {
  RandomStream rng(hash(2, method(), placement(), start()));
  for (const float depth : {0.7f, 6.0f}) {
    const DensityGrid grid = random_grid(rng, {19, 12, 8}, GridContent::uniform_noise);
    const Transform world_from_medium = random_transform(rng, placement());
    const float far = 10 * length(world_from_medium.bounds(box).diagonal());
    RunningMoments error;
    for (int i = 0; i < 20; ++i) {
      const Ray ray = random_ray(rng, start(), box, world_from_medium);
      const double whole =
          reference_optical_depth(grid, box, world_from_medium, ray, double{far});
      if (!(whole > 0)) continue;
      const auto sigma = static_cast<float>(double{depth} / whole);
      const Medium medium(GridMedium(grid, box, world_from_medium,
                                     {Rgb(0.5f * sigma), Rgb(0.5f * sigma), {}},
                                     IsotropicPhase{}));
      const Rgb exact = exact_transmittance(grid, world_from_medium, ray, far, Rgb(sigma));
      for (int k = 0; k < 300; ++k)
        error.add(double{estimate_transmittance(medium, ray, far, rng, method()).r} -
                  double{exact.r});
    }
    EXPECT_GT(z_p_value(error, 0), sidak(0.01, 2 * case_count))
        << "depth " << depth << ": " << error.mean() << " +- " << error.standard_error();
  }
}

// Residual ratio tracking is worth its name where the density varies little within cells,
// and no worse than ratio tracking where it jumps.
TEST(TransmittanceTest, ResidualsVaryLessThanTheWhole) {
  RandomStream rng(14);
  const auto variances = [&](GridContent content, float sigma) {
    const DensityGrid grid = random_grid(rng, {64, 64, 64}, content);
    const Medium medium(
        GridMedium(grid, box, Transform(), {Rgb(0), Rgb(sigma), {}}, IsotropicPhase{}));
    std::array<double, 2> sum{};
    for (int i = 0; i < 100; ++i) {
      const Ray ray = random_ray(rng, RayStart::inside, box, Transform());
      for (size_t m = 0; m < 2; ++m) {
        RunningMoments T;
        for (int k = 0; k < 400; ++k)
          T.add(double{estimate_transmittance(medium, ray, infinity, rng, methods[m]).r});
        sum[m] += T.variance();
      }
    }
    return sum;
  };
  const std::array<double, 2> smooth = variances(GridContent::uniform_noise, 2);
  EXPECT_LT(smooth[1], 0.4 * smooth[0]);
  const std::array<double, 2> sharp = variances(GridContent::mostly_empty, 300);
  EXPECT_LT(sharp[1], 1.05 * sharp[0]);
}

// Many estimates, few rays: bias below 1e-4 of the transmittance.
class FourDigits
    : public testing::TestWithParam<std::tuple<TransmittanceMethod, RayStart>> {};
INSTANTIATE_TEST_SUITE_P(All, FourDigits,
                         testing::Combine(testing::ValuesIn(methods),
                                          testing::ValuesIn(all_ray_starts)));

TEST_P(FourDigits, AgreeWithQuadrature) {
  const auto [method, start] = GetParam();
  RandomStream rng(hash(7, start));
  const DensityGrid grid = random_grid(rng, {12, 10, 14}, GridContent::uniform_noise);
  const Transform world_from_medium = random_transform(rng, Placement::sheared);
  const Ray ray = random_ray(rng, start, box, world_from_medium);
  const double depth = reference_optical_depth(grid, box, world_from_medium, ray, 1000);
  // Thin where the variance is high, so that the digits can be reached in a second.
  const bool is_precise = method == TransmittanceMethod::ray_marching;
  const float sigma = static_cast<float>((is_precise ? 0.2 : 0.01) / depth);
  const Medium medium(
      GridMedium(grid, box, world_from_medium, {Rgb(0), Rgb(sigma), {}}, IsotropicPhase{}));
  const double exact = std::exp(-double{sigma} * depth);
  RunningMoments moments;
  do {
    for (int k = 0; k < 100'000; ++k)
      moments.add(double{estimate_transmittance(medium, ray, infinity, rng, method).r});
    ASSERT_LT(moments.count(), 90'000'000) << "too much variance";
  } while (moments.standard_error() > 2.5e-5 * exact);
  EXPECT_NEAR(moments.mean() / exact, 1, 1e-4) << "depth " << depth * double{sigma};
}

TEST(TransmittanceTest, StaysInItsPromisedRange) {
  RandomStream rng(8);
  for (const GridContent content :
       {GridContent::dynamic_range, GridContent::mostly_empty}) {
    const DensityGrid grid = random_grid(rng, {30, 20, 10}, content);
    const Medium medium(
        GridMedium(grid, box, Transform(), {Rgb(0), {1, 0.1f, 0}, {}}, IsotropicPhase{}));
    for (int i = 0; i < 200; ++i) {
      const Ray ray = random_ray(rng, RayStart::outside, box, Transform());
      const Rgb ratio = estimate_transmittance(medium, ray, 10, rng, methods[0]);
      const Rgb residual = estimate_transmittance(medium, ray, 10, rng, methods[1]);
      const Rgb marched = estimate_transmittance(medium, ray, 10, rng, methods[2]);
      for (int c = 0; c < 3; ++c) {
        ASSERT_GE(ratio[c], 0);
        ASSERT_LE(ratio[c], 1);
        ASSERT_GE(residual[c], 0);
        ASSERT_TRUE(std::isfinite(residual[c]));
        ASSERT_TRUE(std::isfinite(marched[c]));
      }
    }
  }
}

class OneHugeSampleTest : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(All, OneHugeSampleTest, testing::Values(1e6f, 1e8f, 1e29f));

// One sample among ones is so large that a walk with its bound all over the cell would take
// thousands of times as many steps as is good, and end by chance of a step that is too
// small to be one in float: never.
TEST_P(OneHugeSampleTest, IsNoObstacle) {
  DensityGrid grid{{8, 8, 8}, std::vector<float>(512, 1)};
  grid.values[200] = GetParam();
  const Medium medium(GridMedium(grid, {{-1, -1, -1}, {1, 1, 1}}, Transform(),
                                 {Rgb(0.1f), Rgb(1), {}}, IsotropicPhase{}));
  // Sample 200 is the first of its row, at (-7/8, -5/8, -1/8). The first ray goes past it
  // through the cells that it shares, the second into it.
  for (const bool goes_past : {true, false}) {
    const Ray ray{{-2, goes_past ? -0.2f : -0.6f, -0.2f}, {1, 0, 0}};
    const double truth =
        goes_past ? std::exp(-1.1 * reference_optical_depth(grid, {{-1, -1, -1}, {1, 1, 1}},
                                                            Transform(), ray, 4))
                  : 0;
    for (const TransmittanceMethod method :
         {TransmittanceMethod::ratio_tracking,
          TransmittanceMethod::residual_ratio_tracking}) {
      RandomStream rng(hash(7, goes_past, method));
      RunningMoments found;
      for (int i = 0; i < 20'000; ++i)
        found.add(double{estimate_transmittance(medium, ray, 4, rng, method).r});
      EXPECT_NEAR(found.mean(), truth, 5 * found.standard_error() + 1e-6);
    }
  }
}

TEST(TransmittanceTest, IsExactInHomogeneousMedia) {
  RandomStream rng(9);
  const Medium medium(HomogeneousMedium({{1, 0, 0.5f}, {1, 0, 0}, {}}, IsotropicPhase{}));
  const Ray ray{{1, 2, 3}, {0, 0, 1}};
  for (const TransmittanceMethod method : methods) {
    const Rgb T = estimate_transmittance(medium, ray, 3, rng, method);
    EXPECT_FLOAT_EQ(T.r, std::exp(-6.0f));
    EXPECT_EQ(T.g, 1);
    EXPECT_FLOAT_EQ(T.b, std::exp(-1.5f));
    const Rgb far = estimate_transmittance(medium, ray, infinity, rng, method);
    EXPECT_EQ(far, Rgb(0, 1, 0));
  }
}

TEST(TransmittanceTest, IsOneInEmptyGrids) {
  RandomStream rng(10);
  const DensityGrid zero{{4, 4, 4}, std::vector<float>(64)};
  const DensityGrid one{{4, 4, 4}, std::vector<float>(64, 1)};
  const Medium empty(
      GridMedium(zero, box, Transform(), {Rgb(0), Rgb(1), {}}, IsotropicPhase{}));
  const Medium flat(GridMedium(one, {{0, 0, 0}, {1, 0, 1}}, Transform(),
                               {Rgb(0), Rgb(1), {}}, IsotropicPhase{}));
  const Ray ray = random_ray(rng, RayStart::inside, box, Transform());
  for (const TransmittanceMethod method : methods) {
    EXPECT_EQ(estimate_transmittance(empty, ray, infinity, rng, method), Rgb(1));
    EXPECT_EQ(estimate_transmittance(flat, ray, infinity, rng, method), Rgb(1));
  }
}

// A camera a million units away: distances have a resolution of 1/16, and the box is 3
// wide.
TEST(TransmittanceTest, SurvivesHugeDistances) {
  RandomStream rng(11);
  const DensityGrid one{{8, 8, 8}, std::vector<float>(512, 1)};
  const Medium medium(GridMedium(one, {{-2, -2, -2}, {2, 2, 2}}, Transform(),
                                 {Rgb(0), Rgb(0.25f), {}}, IsotropicPhase{}));
  const Ray ray{{-1e6f, 0.1f, -0.3f}, {1, 0, 0}};
  for (const TransmittanceMethod method : methods) {
    RunningMoments moments;
    for (int i = 0; i < 20'000; ++i)
      moments.add(double{estimate_transmittance(medium, ray, infinity, rng, method).r});
    // Optical depth 0.25 * (3 * 1 + 2 * 0.75 * 0.5): it fades to half over half a cell.
    EXPECT_NEAR(moments.mean(), std::exp(-0.9375), 0.02) << static_cast<int>(method);
  }
}

// The estimator of exp(-mean) alone, on estimates of a spread that needs high orders.
TEST(ExponentialOfMeanTest, IsUnbiased) {
  RandomStream rng(12);
  RunningMoments moments;
  for (int i = 0; i < 400'000; ++i) {
    const SeriesOrder series = sample_series_order(rng);
    float x[SeriesOrder::max + 1];
    for (int k = 0; k <= series.order; ++k) x[k] = uniform(rng, 0, 1.4f);
    moments.add(double{exponential_of_mean(x, series)});
  }
  EXPECT_GT(z_p_value(moments, std::exp(-0.7)), 0.01)
      << moments.mean() << " +- " << moments.standard_error();
}

TEST(ExponentialOfMeanTest, OrdersHaveTheirProbabilities) {
  RandomStream rng(13);
  std::array<RunningMoments, 6> reached;
  std::array<double, 6> reach{
      1, 0.1, 0.1, 0.1 * 2 / 3, 0.1 * 2 / 3 / 2, 0.1 * 2 / 3 / 2 * 2 / 5};
  for (int i = 0; i < 200'000; ++i) {
    const SeriesOrder series = sample_series_order(rng);
    for (int k = 1; k < 6; ++k) {
      const size_t at = static_cast<size_t>(k);
      reached[at].add(series.order >= k ? 1 : 0);
      if (series.order < k) continue;
      ASSERT_NEAR(double{series.reach[at]}, reach[at], 1e-7);
    }
  }
  for (size_t k = 1; k < 6; ++k) EXPECT_GT(z_p_value(reached[k], reach[k]), sidak(0.01, 5));
}

}  // namespace
}  // namespace tyndall
