// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/results.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/tyndall/report/error_curve.h"
#include "image/temporary_folder.h"
#include "tyndall/image/whole_file.h"

namespace tyndall::app {
namespace {

Run run_of(double rel_mse, double seconds, uint64_t seed = 0) {
  Run run;
  run.seed = seed;
  run.seconds = seconds;
  run.samples_per_pixel = 100;
  run.errors.rel_mse = rel_mse;
  run.errors.rel_mse_trimmed = rel_mse / 2;
  return run;
}

Results example() {
  Run run = run_of(0.25, 30, 3);
  run.training_seconds = 2;
  run.paths = int64_t{1} << 40;
  run.checkpoints = {{1, 4, 0.1, 0.2, 0.3}, {2, 8, 0.01, 0.02, 0.03}};
  run.errors.psnr = std::numeric_limits<double>::infinity();
  run.errors.ldr_flip = 0.5;
  run.bias = BiasTest{.mean_difference = -0.5, .tiles = 7, .reference_has_variance = false};
  run.image = "a.exr";
  run.counters = {{"guiding.records", 12}};
  run.notes = {"a \"note\""};
  run.command = "tyndall render a.pbrt";
  SceneResults scene{"fog", "fog.pbrt", "0123", 64, 32, "r.exr", 4096, 1e-5, {}};
  scene.methods = {{"learned:a=b", "learned", {{"a", "b"}}, {run}}};
  Results results;
  results.commit = "abc";
  results.machine = {"cpu", "system", 2, 8e9};
  results.time_limit = 30;
  results.scenes = {scene};
  return results;
}

TEST(ResultsTest, SurviveTheFile) {
  const std::string text = to_json(example());
  const Results back = results_from_json(text);
  EXPECT_EQ(to_json(back), text);
  const app::Run& run = back.scenes.at(0).methods.at(0).runs.at(0);
  EXPECT_EQ(run.paths, int64_t{1} << 40);
  EXPECT_EQ(run.checkpoints.at(1).rel_mse, 0.02);
  EXPECT_EQ(run.bias->tiles, 7);
  EXPECT_FALSE(run.bias->reference_has_variance);
  EXPECT_EQ(*run.errors.ldr_flip, 0.5);
  EXPECT_FALSE(run.errors.hdr_flip.has_value());
  EXPECT_TRUE(std::isnan(run.errors.psnr));  // JSON has no infinity
}

TEST(ResultsTest, SayWhatIsWrong) {
  const auto message = [](const std::string& text) {
    return message_of([&] { results_from_json(text); });
  };
  EXPECT_EQ(message("{}"), "not a file of results: \"format\" is not \"tyndall-results\"");
  EXPECT_EQ(message("[1]"), "not a file of results: \"format\" is not \"tyndall-results\"");
  EXPECT_EQ(message(R"({"format": "tyndall-results", "version": 2})"),
            "not a file of results: it has version 2, this program reads version 1");
  EXPECT_TRUE(message("{").starts_with("not a file of results: parse error at line 1"));
  EXPECT_EQ(message(R"({"format": "tyndall-results", "version": 1})"),
            "not a file of results: created is missing");
  std::string text = to_json(example());
  const size_t place = text.find("\"seconds\": 30.0");
  ASSERT_NE(place, std::string::npos) << text;
  EXPECT_EQ(message(text.replace(place, 15, "\"seconds\": true")),
            "not a file of results: scenes[0].methods[0].runs[0].seconds must be a number, "
            "not boolean");
  const TemporaryFolder folder;
  write_whole_file(folder.file("r.json"), "{}");
  EXPECT_EQ(message_of([&] { read_results(folder.file("r.json")); }),
            folder.file("r.json") +
                ": not a file of results: \"format\" is not \"tyndall-results\"");
}

/// Error 1 / t times `factor` at 1, 2, 4, ... seconds.
Run halving_run(double factor, int count) {
  app::Run run;
  for (int i = 0; i < count; ++i) {
    const double t = std::exp2(i);
    run.checkpoints.push_back({t, static_cast<uint32_t>(10 * t), 0, factor / t, 0});
  }
  return run;
}

TEST(ErrorCurveTest, AveragesSeedsWhereAllHaveCheckpoints) {
  Method method{"m", "m", {}, {halving_run(1, 5), halving_run(4, 4)}};
  method.runs[0].training_seconds = 3;
  const ErrorCurve curve = error_curve(method, CurveAxis::seconds);
  ASSERT_EQ(curve.points.size(), 41u);
  EXPECT_NEAR(curve.points.front().x, 1, 1e-9);
  EXPECT_NEAR(curve.points.back().x, 8, 1e-9);
  for (const ErrorCurve::Point& p : curve.points) {
    EXPECT_NEAR(p.mean, 2 / p.x, 1e-9);  // lines are straight between checkpoints
    EXPECT_NEAR(p.low, 1 / p.x, 1e-9);
    EXPECT_NEAR(p.high, 4 / p.x, 1e-9);
  }
  EXPECT_EQ(curve.training, 1.5);
  EXPECT_NEAR(error_curve(method, CurveAxis::samples_per_pixel).points.back().x, 80, 1e-6);
}

TEST(ErrorCurveTest, TakesRunsWithoutUsableCheckpoints) {
  Method method{"m", "m", {}, {halving_run(1, 1), app::Run{}}};
  method.runs[1].checkpoints = {{1, 1, 0, 0, 0}, {2, 2, 0, std::nan(""), 0}};
  EXPECT_TRUE(error_curve(method, CurveAxis::seconds).points.empty());
  EXPECT_EQ(svg_plot({error_curve(method, CurveAxis::seconds)}, "seconds", 0),
            "<p>Too few checkpoints for a plot.</p>");
}

TEST(ErrorCurveTest, PlotEscapesNames) {
  const Method method{"a<b", "m", {}, {halving_run(1, 5)}};
  const std::string svg = svg_plot({error_curve(method, CurveAxis::seconds)}, "s", 3);
  EXPECT_EQ(svg.find("a<b"), std::string::npos);
  EXPECT_NE(svg.find("a&lt;b"), std::string::npos);
  EXPECT_NE(svg.find("class=\"marker\""), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace tyndall::app
