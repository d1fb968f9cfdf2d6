// SPDX-License-Identifier: Apache-2.0
#include "tyndall/techniques/binned_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/chi_square.h"
#include "techniques/technique_checks.h"
#include "tyndall/math/statistics.h"
#include "tyndall/techniques/double_scattering_distance.h"
#include "tyndall/techniques/equiangular.h"
#include "tyndall/techniques/exponential_distance.h"
#include "tyndall/techniques/fast_log.h"

namespace tyndall {
namespace {

constexpr int bins = 32, taps = 64;
using Binned = BinnedDistance<EquiangularSampling, bins>;
static_assert(DistanceTechnique<Binned>);
static_assert(DistanceTechnique<BinnedDistance<DoubleScatteringDistance, bins>>);
static_assert(DistanceTechnique<ExponentialDistance>);

const Geometry beside{"beside", 1, 2, 0, 5};
const Geometry mirrored{"ahead", 0.5f, 6, 0.25f, 4};

EquiangularSampling base(const Geometry& g) {
  return {g.ray(), g.pivot(), g.t_min, g.t_max};
}

/// Bright and dark bins by turns, of one tap each.
DistanceWeights<taps> stripes() {
  auto weights = DistanceWeights<taps>::ones();
  for (size_t i = 0; i < taps; ++i)
    weights.values[i] = i % 8 < 4 ? static_cast<float>(i) : 0;
  return weights;
}

TEST(FastLog, IsTheLogarithm) {
  for (float x = 1e-37f; x < 1e30f; x *= 1.0007f) {
    const double exact = std::log(double{x});
    EXPECT_NEAR(fast_log(x), exact, 3e-7 * std::max(1.0, std::abs(exact))) << x;
  }
  EXPECT_EQ(fast_log(1), 0);
}

TEST(BinnedDistance, SamplesFollowTheirPdf) {
  for (const Geometry& geometry : {beside, mirrored}) {
    const Binned technique(base(geometry), stripes(), 0.1f);
    // In the base's uniform number the density is constant in each of the test's cells.
    const ChiSquareResult result = chi_square_line(
        [&](float u) -> std::optional<float> {
          return base(geometry).invert(technique.sample(u)->t);
        },
        [&](double x) {
          const float t = base(geometry).sample(static_cast<float>(x))->t;
          return technique.pdf_t(t) / base(geometry).pdf_t(t);
        },
        0, 1, 100'000);
    EXPECT_GT(result.p_value, sidak(0.01, 2)) << result;
    EXPECT_NEAR(result.mass, 1, 1e-4);
    EXPECT_EQ(result.samples_of_zero_pdf, 0);
    for (float u = 0.003f; u < 1; u += 0.0071f) {
      const auto sample = technique.sample(u);
      EXPECT_NEAR(technique.invert(sample->t), u, 2e-6);
      EXPECT_NEAR(technique.pdf_t(sample->t) / sample->pdf_t, 1, 1e-5);
    }
  }
}

TEST(BinnedDistance, WithFewerBinsIsTheSameDensity) {
  auto few = DistanceWeights<8>::ones();
  for (size_t i = 0; i < 8; ++i) few.values[i] = i % 3 == 0 ? 0.1f : static_cast<float>(i);
  const auto technique = Binned::with_bins_of(base(beside), few, 0.1f);
  const Binned shared(base(beside), few, 0.1f);
  for (float u = 0.003f; u < 1; u += 0.0071f) {
    const auto sample = technique.sample(u);
    EXPECT_NEAR(sample->t, shared.sample(u)->t, 2e-5);
    EXPECT_NEAR(technique.pdf_t(sample->t) / sample->pdf_t, 1, 1e-5);
    EXPECT_NEAR(technique.invert(sample->t), u, 2e-6);
    // A rounding of one against the narrowest bin, 0.1 / 32 wide.
    EXPECT_NEAR(technique.pdf_t(5 * u) / shared.pdf_t(5 * u), 1, 4e-5);
  }
}

TEST(BinnedDistance, IsTheProductOfBaseAndWeights) {
  constexpr float floor = 0.1f;
  const Binned technique(base(beside), stripes(), floor);
  const auto weights = stripes();
  float total = 0;
  for (const float w : weights.values) total += w;
  for (int bin = 0; bin < bins; ++bin) {
    const float t = base(beside).sample((static_cast<float>(bin) + 0.5f) / bins)->t;
    const auto i = static_cast<size_t>(2 * bin);
    const float share = (weights.values[i] + weights.values[i + 1]) / total;
    const float expected = (1 - floor) * bins * share + floor;
    EXPECT_NEAR(technique.pdf_t(t) / base(beside).pdf_t(t), expected,
                4e-6 + 1e-5 * expected)
        << bin;
  }
}

TEST(BinnedDistance, IsItsBaseForEqualOrUselessWeights) {
  auto zeros = DistanceWeights<taps>::ones(), bad = zeros;
  zeros.values.fill(0);
  for (size_t i = 0; i < taps; ++i)
    bad.values[i] = i % 3 == 0   ? std::numeric_limits<float>::quiet_NaN()
                    : i % 3 == 1 ? -1.0f
                                 : infinity;
  for (const auto& weights : {DistanceWeights<taps>::ones(), zeros, bad}) {
    const Binned technique(base(beside), weights, 0.05f);
    for (float u = 0.01f; u < 1; u += 0.05f) {
      EXPECT_NEAR(technique.sample(u)->t, base(beside).sample(u)->t, 2e-6);
      EXPECT_NEAR(technique.pdf_t(5 * u) / base(beside).pdf_t(5 * u), 1, 1e-5);
    }
  }
}

// The point of it all: with transmittance and phase function in the bins, what is left of
// the variance is their change within a bin.
TEST(BinnedDistance, RemovesTheVarianceOfWhatItIsTold) {
  constexpr float sigma_t = 0.7f, g = 0.6f;
  const auto f = [&](double t) {
    const double r = beside.r(t), cosine = -beside.s(t) / r;
    return std::exp(-sigma_t * (t + r)) * std::pow(1 + g * g - 2 * g * cosine, -1.5) /
           (r * r);
  };
  const auto taps_at = base(beside).taps<taps>();
  auto weights = DistanceWeights<taps>::ones();
  weights.multiply_transmittance(taps_at, sigma_t).multiply_phase(taps_at, g);
  const Binned technique(base(beside), weights, 0.01f);
  RunningMoments plain, binned;
  for (int i = 0; i < 4096; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / 4096;
    const auto a = base(beside).sample(u), b = technique.sample(u);
    plain.add(f(a->t) / a->pdf_t);
    binned.add(f(b->t) / b->pdf_t);
  }
  EXPECT_NEAR(binned.mean() / plain.mean(), 1, 1e-4);
  EXPECT_LT(binned.variance(), 0.01 * plain.variance());
}

TEST(BinnedDistance, WorksOverTheDoubleScatteringDistance) {
  const ScatteringTables isotropic(0);
  const DoubleScatteringDistance distance(isotropic, beside.ray(), beside.pivot(), 0, 5);
  const auto taps_at = distance.taps<taps>();
  auto weights = DistanceWeights<taps>::ones();
  weights.multiply_transmittance(taps_at, 0.5f);
  const BinnedDistance<DoubleScatteringDistance, bins> technique(distance, weights, 0.05f);
  for (float u = 0.003f; u < 1; u += 0.0171f) {
    const auto sample = technique.sample(u);
    EXPECT_NEAR(technique.invert(sample->t), u, 2e-6);
    EXPECT_NEAR(technique.pdf_t(sample->t) / sample->pdf_t, 1, 1e-5);
  }
  // More near the ray's origin, where there is more light left, than without the medium.
  EXPECT_GT(technique.pdf_t(0.1f), 1.5f * distance.pdf_t(0.1f));
  EXPECT_LT(technique.pdf_t(4.9f), 0.5f * distance.pdf_t(4.9f));
}

TEST(DistanceWeights, OpticalDepthsAreTransmittance) {
  std::array<float, taps> depth;
  for (size_t i = 0; i < taps; ++i) depth[i] = 0.3f * static_cast<float>(i);
  auto weights = DistanceWeights<taps>::ones();
  weights.multiply_transmittance(depth);
  for (size_t i = 0; i < taps; ++i)
    EXPECT_NEAR(weights.values[i] / std::exp(-depth[i]), 1, 1e-5) << i;
}

TEST(FastExp, IsCloseAndAlwaysPositive) {
  for (float x = -85; x < 85; x += 0.0137f)
    EXPECT_NEAR(fast_exp(x) / std::exp(double(x)), 1, 4e-6 + 1e-7 * std::abs(x)) << x;
  for (const float x :
       {1e30f, -1e30f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_GT(fast_exp(x), 0) << x;
    EXPECT_LT(fast_exp(x), infinity) << x;
  }
}

class ExponentialDistanceTest : public testing::TestWithParam<std::tuple<float, float>> {};
INSTANTIATE_TEST_SUITE_P(Media, ExponentialDistanceTest,
                         testing::Values(std::tuple{0.0f, 5.0f}, std::tuple{1e-8f, 5.0f},
                                         std::tuple{0.7f, 5.0f}, std::tuple{300.0f, 5.0f},
                                         std::tuple{0.7f, infinity}));

TEST_P(ExponentialDistanceTest, IsTheTransmittance) {
  const auto [sigma_t, t_max] = GetParam();
  const float t_min = 1;
  const ExponentialDistance technique(sigma_t, t_min, t_max);
  const double whole = sigma_t > 0
                           ? -std::expm1(-double(sigma_t) * (t_max - t_min)) / sigma_t
                           : t_max - t_min;
  for (float u = 0.01f; u < 1; u += 0.0137f) {
    const auto sample = technique.sample(u);
    ASSERT_TRUE(sample.has_value());
    const double way = sample->t - t_min, depth = sigma_t * way;
    EXPECT_NEAR(sample->pdf_t * whole / std::exp(-depth), 1, 2e-6 + 1e-7 * depth);
    const double part = sigma_t > 0 ? -std::expm1(-depth) / sigma_t : way;
    EXPECT_NEAR(part / whole, u, 1e-6 + 8 * ulp(sample->t) * sample->pdf_t);
    EXPECT_NEAR(technique.invert(sample->t), u, 1e-6 + 8 * ulp(sample->t) * sample->pdf_t);
  }
}

TEST(ExponentialDistance, IsEmptyForEmptyAndDivergentStretches) {
  EXPECT_FALSE(ExponentialDistance(0, 1, infinity).sample(0.5f));
  EXPECT_FALSE(ExponentialDistance(1, 2, 2).sample(0.5f));
  EXPECT_FALSE(ExponentialDistance(-1, 0, 2).sample(0.5f));
}

}  // namespace
}  // namespace tyndall
