// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/online_em.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "guiding/mixtures.h"
#include "tyndall/math/constants.h"
#include "tyndall/math/statistics.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

using Points = std::vector<WeightedPoint>;

Points points_of(const GaussianMixture& mixture, int n, uint64_t seed) {
  RandomStream random(seed);
  Points points;
  while (static_cast<int>(points.size()) < n)
    if (const auto s = mixture.sample(random.next_2d())) points.push_back({s->p, 1});
  return points;
}

GaussianMixture three_lobes() {
  return GaussianMixture(
      std::vector<GaussianComponent>{{0.5f, {0.25f, 0.3f}, {0.004f, 0.002f, 0.003f}},
                                     {0.3f, {0.7f, 0.65f}, {0.002f, -0.001f, 0.006f}},
                                     {0.2f, {0.3f, 0.8f}, {0.001f, 0, 0.001f}}});
}

/// Kullback-Leibler divergence of `fit` from `truth`, by samples of the truth.
double divergence(const GaussianMixture& truth, const GaussianMixture& fit) {
  RunningMoments m;
  for (const WeightedPoint& s : points_of(truth, 20'000, 99))
    m.add(std::log(static_cast<double>(truth.pdf(s.p) / fit.pdf(s.p))));
  return m.mean();
}

/// All numbers of the mixtures agree up to a share of `tolerance`.
void expect_close(const GaussianMixture& a, const GaussianMixture& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (int k = 0; k < a.size(); ++k) {
    const GaussianComponent s = a.component(k), t = b.component(k);
    EXPECT_NEAR(s.weight, t.weight, tolerance);
    EXPECT_NEAR(s.mean.x, t.mean.x, tolerance);
    EXPECT_NEAR(s.mean.y, t.mean.y, tolerance);
    EXPECT_NEAR(s.covariance.xx, t.covariance.xx, tolerance * t.covariance.xx);
    EXPECT_NEAR(s.covariance.yy, t.covariance.yy, tolerance * t.covariance.yy);
    EXPECT_NEAR(s.covariance.xy, t.covariance.xy, tolerance * t.covariance.xx);
  }
}

TEST(BatchEmTest, RecoversAKnownMixture) {
  EmSettings settings;
  settings.components = 3;
  const Points points = points_of(three_lobes(), 40'000, 5);
  const GaussianMixture fit =
      fit_batch(initial_mixture(points, 1, settings), points, settings, 200, 1e-7);

  std::vector<GaussianComponent> found;
  for (int k = 0; k < fit.size(); ++k) found.push_back(fit.component(k));
  std::sort(found.begin(), found.end(),
            [](auto& a, auto& b) { return a.weight > b.weight; });
  ASSERT_EQ(found.size(), 3u);
  // Four standard errors: of a weight sqrt(.25 / 40000), of a mean sqrt(.006 / 8000).
  for (int k = 0; k < 3; ++k) {
    const GaussianComponent truth = three_lobes().component(k);
    const GaussianComponent& f = found[static_cast<size_t>(k)];
    EXPECT_NEAR(f.weight, truth.weight, 0.01);
    EXPECT_NEAR(f.mean.x, truth.mean.x, 0.0035);
    EXPECT_NEAR(f.mean.y, truth.mean.y, 0.0035);
    EXPECT_NEAR(f.covariance.xx, truth.covariance.xx, 0.07 * truth.covariance.xx);
    EXPECT_NEAR(f.covariance.yy, truth.covariance.yy, 0.07 * truth.covariance.yy);
    EXPECT_NEAR(f.covariance.xy, truth.covariance.xy, 1.5e-4);
  }
}

// Points drawn evenly and weighted by the density tell the same as points of the density.
TEST(BatchEmTest, WeightsStandForDensity) {
  EmSettings settings;
  RandomStream random(3);
  Points points(40'000);
  for (WeightedPoint& s : points) {
    s.p = random.next_2d();
    s.weight = three_lobes().pdf(s.p);
  }
  const GaussianMixture fit =
      fit_batch(initial_mixture(points, 1, settings), points, settings, 100, 1e-6);
  EXPECT_LT(divergence(three_lobes(), fit), 0.01);
  EXPECT_GT(divergence(three_lobes(), GaussianMixture()), 1);
}

TEST(BatchEmTest, PenalizedLikelihoodNeverFalls) {
  for (const NamedMixture& example : example_mixtures()) {
    for (const int n : {3, 20, 2000}) {
      EmSettings settings;
      settings.weight_count = 0.1;
      Points points = points_of(GaussianMixture(example.components), n, 11);
      RandomStream random(n);
      for (WeightedPoint& s : points) {
        const float dividend = random.next_1d();
        s.weight = dividend / (0.01f + random.next_1d());
      }
      GaussianMixture mixture = initial_mixture(points, 2, settings);
      double last = penalized_log_likelihood(mixture, points, settings);
      for (int sweep = 0; sweep < 40; ++sweep) {
        MixtureStatistics s;
        s.add(mixture, points);
        mixture = maximize(s, mixture, settings);
        const double now = penalized_log_likelihood(mixture, points, settings);
        // Single precision of the mixture's numbers.
        ASSERT_GT(now, last - 1e-5 * (1 + std::abs(last))) << example.name << " n = " << n;
        last = now;
      }
    }
  }
}

// The M step is the maximum: no small change of its result is better.
TEST(BatchEmTest, MaximizeIsStationary) {
  EmSettings settings;
  settings.components = 1;  // no hidden variable: one step is the maximum
  settings.covariance_count = 3;
  settings.covariance_scale = 0.02;
  const Points points = points_of(GaussianMixture(example_mixtures()[2].components), 30, 4);
  MixtureStatistics s;
  const GaussianMixture start = initial_mixture(points, 1, settings);
  s.add(start, points);
  const GaussianMixture best = maximize(s, start, settings);
  const double top = penalized_log_likelihood(best, points, settings);
  for (int i = 0; i < 5; ++i)
    for (const float step : {-0.002f, 0.002f}) {
      GaussianComponent c = best.component(0);
      float* numbers[] = {&c.mean.x, &c.mean.y, &c.covariance.xx, &c.covariance.xy,
                          &c.covariance.yy};
      *numbers[i] *= 1 + step;
      EXPECT_LT(penalized_log_likelihood(GaussianMixture({&c, 1}), points, settings), top);
    }
}

TEST(MixtureStatisticsTest, PartsAddUpToTheWhole) {
  const Points points = points_of(three_lobes(), 999, 8);
  const GaussianMixture mixture(example_mixtures().back().components);
  const std::span<const WeightedPoint> all(points);
  MixtureStatistics whole, parts;
  whole.add(mixture, all);
  for (const auto& [begin, size] : {std::pair{0, 100}, {100, 1}, {101, 898}}) {
    MixtureStatistics part;
    part.add(mixture, all.subspan(static_cast<size_t>(begin), static_cast<size_t>(size)));
    parts += part;
  }
  EXPECT_EQ(parts.count, whole.count);
  EXPECT_NEAR(parts.log_density, whole.log_density, 1e-9 * std::abs(whole.log_density));
  EXPECT_NEAR(parts.squared_weight, whole.squared_weight, 1e-9);
  for (size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(parts.w[k], whole.w[k], 1e-9);
    EXPECT_NEAR(parts.xy[k], whole.xy[k], 1e-9);
  }
  const double total = std::accumulate(whole.w.begin(), whole.w.end(), 0.0);
  EXPECT_NEAR(total, whole.weight, 1e-4);
  EmSettings settings;
  expect_close(maximize(parts, mixture, settings), maximize(whole, mixture, settings),
               1e-5);
}

TEST(MixtureStatisticsTest, SurvivesWritingAndReading) {
  MixtureStatistics s;
  s.add(three_lobes(), points_of(three_lobes(), 100, 8));
  s.rejected = 3;
  ByteWriter out;
  s.write(out);
  ByteReader in(out.bytes());
  MixtureStatistics back;
  back.read(in);
  EXPECT_EQ(back, s);
  EXPECT_FALSE(in.failed());
  EXPECT_EQ(in.remaining(), 0u);
  back.read(in);
  EXPECT_TRUE(in.failed());
}

// Endianness: the bytes are fixed, not only the round trip.
TEST(ByteStreamTest, IsLittleEndian) {
  ByteWriter out;
  out.write(uint32_t{0x01020304});
  out.write(1.0f);
  const std::vector<std::byte> expected{std::byte{4},    std::byte{3},   std::byte{2},
                                        std::byte{1},    std::byte{0},   std::byte{0},
                                        std::byte{0x80}, std::byte{0x3f}};
  EXPECT_EQ(out.bytes(), expected);
}

// With step 1/n the running statistics are the plain sums, however the samples are cut.
TEST(OnlineEmTest, StepOneOverNEqualsBatchSums) {
  EmSettings settings;
  settings.step_exponent = 1;
  const Points points = points_of(three_lobes(), 1000, 8);
  const GaussianMixture mixture(example_mixtures().back().components);
  MixtureStatistics whole;
  whole.add(mixture, points);
  OnlineEm em;
  for (size_t i = 0; i < points.size(); i += 50) {
    MixtureStatistics part;
    part.add(mixture, std::span(points).subspan(i, 50));
    em.absorb(part, settings);
  }
  EXPECT_EQ(em.samples(), 1000);
  EXPECT_NEAR(em.statistics().count, 1000, 1e-9);
  for (size_t k = 0; k < 8; ++k)
    EXPECT_NEAR(em.statistics().xx[k], whole.xx[k], 1e-9 * (1 + whole.xx[k]));
  EXPECT_NEAR(em.statistics().effective_count(), 1000, 1e-9);
}

// The share of the past that absorb() leaves is that of [Vorba14]'s recursion, sample by
// sample.
TEST(OnlineEmTest, ForgetsLikeTheRecursion) {
  EmSettings settings;
  settings.step_exponent = 0.7;
  const Points left(1000, {{0.2f, 0.5f}, 1}), right(500, {{0.8f, 0.5f}, 1});
  const GaussianMixture mixture = three_lobes();
  OnlineEm em;
  for (const Points* points : {&left, &right}) {
    MixtureStatistics s;
    s.add(mixture, *points);
    em.absorb(s, settings);
  }
  double past = 1;
  for (int n = 1000; n < 1500; ++n) past *= 1 - std::pow(n + 1.0, -0.7);
  const MixtureStatistics& s = em.statistics();
  const double mean_x = std::accumulate(s.x.begin(), s.x.end(), 0.0) / s.weight;
  EXPECT_NEAR((0.8 - mean_x) / 0.6, past, 0.03 * past + 1e-6);
}

TEST(OnlineEmTest, LearnsFromAStream) {
  EmSettings settings;
  const Points points = points_of(three_lobes(), 30'000, 21);
  const std::span<const WeightedPoint> all(points);
  GaussianMixture mixture = initial_mixture(all.first(200), 1, settings);
  OnlineEm em;
  for (size_t i = 0; i < points.size(); i += 10) {
    MixtureStatistics s;
    s.add(mixture, all.subspan(i, 10));
    em.absorb(s, settings);
    mixture = em.maximize(mixture, settings);
  }
  EXPECT_LT(divergence(three_lobes(), mixture), 0.03);
}

TEST(OnlineEmTest, TheScaleOfTheWeightsDoesNotMatter) {
  EmSettings settings;
  Points points = points_of(three_lobes(), 500, 8);
  for (size_t i = 0; i < points.size(); ++i)
    points[i].weight = 1.0f + static_cast<float>(i % 7);
  const GaussianMixture start = initial_mixture(points, 1, settings);
  std::vector<GaussianMixture> fits;
  for (const float scale : {1.0f, 0x1p-90f, 0x1p90f}) {
    Points scaled = points;
    for (WeightedPoint& s : scaled) s.weight *= scale;
    EXPECT_EQ(initial_mixture(scaled, 1, settings), start);
    OnlineEm em;
    GaussianMixture mixture = start;
    for (int batch = 0; batch < 5; ++batch) {
      MixtureStatistics s;
      s.add(mixture, std::span(scaled).subspan(static_cast<size_t>(batch) * 100, 100));
      em.absorb(s, settings);
      mixture = em.maximize(mixture, settings);
    }
    fits.push_back(mixture);
  }
  EXPECT_EQ(fits[0], fits[1]);
  EXPECT_EQ(fits[0], fits[2]);
}

TEST(OnlineEmTest, ForgettingLetsLaterSamplesSpeakLouder) {
  EmSettings settings;
  settings.step_exponent = 1;
  const GaussianMixture mixture = three_lobes();
  MixtureStatistics first, second;
  first.add(mixture, Points(1000, {{0.2f, 0.5f}, 1}));
  second.add(mixture, Points(100, {{0.8f, 0.5f}, 1}));
  OnlineEm em;
  em.absorb(first, settings);
  em.forget(0.1);
  EXPECT_NEAR(em.statistics().effective_count(), 100, 1e-9);
  em.absorb(second, settings);
  const MixtureStatistics& s = em.statistics();
  EXPECT_NEAR(std::accumulate(s.x.begin(), s.x.end(), 0.0) / s.weight, 0.5, 1e-6);
}

/// Sets of samples that break naive covariances.
std::vector<Points> adversarial_points() {
  Points same(100'000, {{0.3f, 0.7f}, 1}), diagonal, corners, spike, tiny, edge;
  for (int i = 0; i < 20'000; ++i) {
    const float t = static_cast<float>(i) / 20'000;
    diagonal.push_back({{t, t}, 1});
    corners.push_back({{static_cast<float>(i & 1), static_cast<float>((i >> 1) & 1)}, 1});
    spike.push_back({{t, 0.5f}, i == 77 ? 1e30f : 1e-30f});
    tiny.push_back({{t, 1 - t}, 1e-38f});
    edge.push_back({{1, t}, t});
  }
  return {same, diagonal, corners, spike, tiny, edge, Points{{{0, 0}, 5}}, Points{}};
}

TEST(OnlineEmTest, CovariancesStayPositiveDefinite) {
  EmSettings settings;
  for (const double scale : {5e-4, 1e-30}) {
    settings.covariance_scale = scale;
    for (const Points& points : adversarial_points()) {
      GaussianMixture mixture = initial_mixture(points, 1, settings);
      OnlineEm em;
      for (int sweep = 0; sweep < 8; ++sweep) {
        MixtureStatistics s;
        s.add(mixture, points);
        em.absorb(s, settings);
        mixture = em.maximize(mixture, settings);
      }
      float total = 0;
      for (int k = 0; k < mixture.size(); ++k) {
        const GaussianComponent c = mixture.component(k);
        total += c.weight;
        EXPECT_GT(c.covariance.xx, 0);
        EXPECT_GT(c.covariance.determinant(), 0);
        EXPECT_TRUE(c.mean.x >= 0 && c.mean.x <= 1 && c.mean.y >= 0 && c.mean.y <= 1);
      }
      EXPECT_NEAR(total, mixture.is_uniform() ? 0 : 1, 1e-5);
      for (const Vec2 p : {Vec2{0, 0}, Vec2{0.5f, 0.5f}, Vec2{0.3f, 0.7f}, Vec2{1, 1}})
        EXPECT_TRUE(std::isfinite(mixture.pdf(p)) && mixture.pdf(p) > 0);
    }
  }
}

TEST(MixtureStatisticsTest, RejectsAndCountsWhatIsNoSample) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Points points{{{0.5f, 0.5f}, nan}, {{0.5f, 0.5f}, -1}, {{0.5f, 0.5f}, infinity},
                      {{nan, 0.5f}, 1},    {{0.5f, 1.5f}, 1},  {{0.5f, 0.5f}, 0},
                      {{0.5f, 0.5f}, 2}};
  MixtureStatistics s;
  s.add(three_lobes(), points);
  EXPECT_EQ(s.rejected, 5u);
  EXPECT_EQ(s.count, 2);
  EXPECT_EQ(s.weight, 2);
}

// Zeros alone teach nothing and change nothing.
TEST(OnlineEmTest, ZeroWeightsLeaveTheMixtureAlone) {
  EmSettings settings;
  MixtureStatistics s;
  s.add(three_lobes(), Points(50, {{0.5f, 0.5f}, 0}));
  EXPECT_EQ(maximize(s, three_lobes(), settings), three_lobes());
  EXPECT_TRUE(initial_mixture(Points(50, {{0.5f, 0.5f}, 0}), 1, settings).is_uniform());
}

// A few heavy samples among many do not shrink the covariances below their prior.
TEST(BatchEmTest, HeavySamplesCountAsFew) {
  EmSettings settings;
  settings.components = 1;
  Points points(10'000, {{0.5f, 0.5f}, 1e-6f});
  points[5].weight = 1;
  const GaussianMixture fit =
      fit_batch(initial_mixture(points, 1, settings), points, settings, 50, 0);
  const double n = 1.0201;  // (1 + 0.01)^2 / (1 + 1e-8)
  EXPECT_NEAR(fit.component(0).covariance.xx, 5e-4 / (0.01 + n), 1e-5);
}

}  // namespace
}  // namespace tyndall
