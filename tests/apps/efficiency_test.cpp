// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/efficiency.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tyndall/image/metrics.h"
#include "tyndall/integrators/render.h"
#include "tyndall/loader/load_scene.h"

namespace tyndall::app {
namespace {

Run run_of(double rel_mse, double seconds) {
  Run run;
  run.seconds = seconds;
  run.samples_per_pixel = 100;
  run.errors.rel_mse = rel_mse;
  run.errors.rel_mse_trimmed = rel_mse / 2;
  return run;
}

TEST(EfficiencyTest, RatioIsOfGeometricMeans) {
  const std::vector<app::Run> slow = {run_of(0.4, 10), run_of(0.1, 10)};
  const std::vector<app::Run> fast = {run_of(0.1, 5), run_of(0.025, 5)};
  const auto ratio = cost_ratio(fast, slow, cost_in_time);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->ratio, 8, 1e-12);  // 0.2 * 10 / (0.05 * 5)
  // Standard error of a mean logarithm: ln 4 / 2; two of them; 2 degrees of freedom.
  const double half = 4.303 * std::sqrt(2.0) * std::log(4) / 2;
  EXPECT_NEAR(ratio->interval->low, 8 * std::exp(-half), 1e-9);
  EXPECT_NEAR(ratio->interval->high, 8 * std::exp(half), 1e-6);
  EXPECT_NEAR(cost_ratio(fast, slow, cost_in_samples)->ratio, 4, 1e-12);
  EXPECT_NEAR(cost_ratio(fast, slow, trimmed_cost_in_time)->ratio, 8, 1e-12);
}

TEST(EfficiencyTest, IsEmptyWhereThereIsNoRatio) {
  const std::vector<app::Run> one = {run_of(0.4, 10)},
                              two = {run_of(0.4, 10), run_of(0.3, 10)};
  const std::vector<app::Run> exact = {run_of(0, 10), run_of(0, 10)};
  EXPECT_FALSE(cost_ratio({}, two, cost_in_time));
  EXPECT_FALSE(cost_ratio(two, exact, cost_in_time));
  const auto without_interval = cost_ratio(one, two, cost_in_time);
  ASSERT_TRUE(without_interval);
  EXPECT_FALSE(without_interval->interval);
}

TEST(EfficiencyTest, SaysWhatTimeIsSaved) {
  const Method slow{"slow", "volpath", {}, {run_of(0.4, 10)}};
  Method fast{"fast", "learned", {}, {run_of(0.1, 10)}};
  EXPECT_EQ(time_sentence(fast, slow),
            "the same error as slow in 4 times less time; without the worst 0.1 % of the "
            "pixels in 4 times less time");
  fast.runs[0].errors.rel_mse_trimmed = 0;
  EXPECT_EQ(time_sentence(fast, slow), "");
}

TEST(EfficiencyTest, RatiosAsWords) {
  EXPECT_EQ((RatioEstimate{2.5, {}}).text(), "2.5");
  EXPECT_EQ((RatioEstimate{2.5, {{2, 3.1}}}).text(), "2.5 (2 to 3.1)");
  EXPECT_EQ((RatioEstimate{2.5, {}}).time_words(), "2.5 times less time");
  EXPECT_EQ((RatioEstimate{0.8, {{0.5, 2}}}).time_words(),
            "1.25 times the time (95 % confidence: 0.5 to 2)");
}

// What issue 6 asks for: the interval of an integrator against itself holds 1 in 19 of 20.
TEST(EfficiencyTest, IntervalHoldsOneForTheSameMethod) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.3);
  const auto runs = [&] {
    std::vector<app::Run> result;
    for (int i = 0; i < 5; ++i) result.push_back(run_of(std::exp(noise(random)), 30));
    return result;
  };
  int misses = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto ratio = cost_ratio(runs(), runs(), cost_in_time);
    misses += ratio->interval->low > 1 || ratio->interval->high < 1;
  }
  EXPECT_NEAR(misses / 2000.0, 0.05, 0.015);  // three standard errors
}

TEST(EfficiencyTest, StudentQuantilesAreTheTables) {
  EXPECT_EQ(student_quantile_975(1), 12.706);
  EXPECT_EQ(student_quantile_975(8), 2.306);
  EXPECT_EQ(student_quantile_975(8.9), 2.306);
  EXPECT_EQ(student_quantile_975(0.5), 12.706);
  EXPECT_NEAR(student_quantile_975(1e9), 1.96, 0.02);
}

/// A ball lamp in fog, 12 x 8 pixels.
LoadedScene lamp_in_fog() {
  return parse_scene(R"(
Film "rgb" "integer xresolution" 12 "integer yresolution" 8
PixelFilter "box"
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [.2 .2 .2] "rgb sigma_a" [0 0 0]
LookAt 0 0 -5  0 0 0  0 1 0
MediumInterface "" "fog"
Camera "perspective" "float fov" 50
WorldBegin
MediumInterface "fog" "fog"
AttributeBegin
AreaLightSource "diffuse" "rgb L" [8 8 8]
Shape "sphere" "float radius" 0.5
AttributeEnd
Material "diffuse" "rgb reflectance" [.2 .2 .2]
Shape "sphere" "float radius" 30
)",
                     "fog.pbrt");
}

/// Renders of one integrator against one reference, all with seeds of their own.
std::vector<Run> rendered_runs(size_t count) {
  LoadedScene loaded = lamp_in_fog();
  const Scene scene(std::move(loaded.scene));
  RenderSettings settings = loaded.settings;
  settings.integrator = "volpath";
  settings.max_depth = 3;
  const auto image = [&](uint64_t seed, uint32_t samples) {
    settings.seed = seed;
    settings.samples_per_pixel = samples;
    RenderOptions options;
    options.threads = 1;
    return render(scene, settings, options).film.develop();
  };
  const Image reference = image(1'000'000, 4096);
  std::vector<Run> runs(count);
  for (size_t i = 0; i < count; ++i) {
    runs[i].samples_per_pixel = 16;
    runs[i].errors = measure_errors(image(i, 16), reference, {.with_flip = false});
  }
  return runs;
}

// What issue 6 asks for, with real renders: of 20 benchmarks of an integrator against
// itself, five seeds each, 19 print an interval that holds one.
TEST(EfficiencyTest, NineteenOfTwentyBenchmarksOfTheSameIntegratorHoldOne) {
  constexpr size_t seeds = 5;
  const auto runs = rendered_runs(20 * 2 * seeds);
  int holds = 0;
  for (auto part = runs.begin(); part != runs.end(); part += 2 * seeds) {
    const std::vector<app::Run> a(part, part + seeds), b(part + seeds, part + 2 * seeds);
    const auto interval = cost_ratio(a, b, cost_in_samples).value().interval.value();
    holds += interval.low <= 1 && interval.high >= 1;
  }
  RecordProperty("holds", holds);
  EXPECT_GE(holds, 19);
}

}  // namespace
}  // namespace tyndall::app
