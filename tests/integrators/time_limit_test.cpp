// SPDX-License-Identifier: Apache-2.0
// Renders that a time limit or a signal ends amid a pass.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>

#include "scenes.h"

namespace tyndall {
namespace {

SceneDescription foggy_ball(Vec2i resolution) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -3}, {0, 0, 0}, 40, resolution);
  d.media.push_back(test::grey_fog(1, 0.1f, 0.4f));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.surfaces.push_back(test::diffuse_disk(1.5f, 3, 0.5f));
  d.lights.push_back(Light(PointLight{{0.5f, 0.9f, -1.5f}, Rgb(5)}));
  return d;
}

RenderSettings settings_of(Vec2i resolution, const std::string& integrator) {
  RenderSettings s = test::settings(integrator, 6);
  s.resolution = s.crop_max = resolution;
  s.samples_per_pixel = 100'000'000;
  return s;
}

RenderOptions within(double seconds, int threads) {
  RenderOptions options;
  options.time_limit = seconds;
  options.threads = threads;
  return options;
}

// Each pixel is that of a picture of as many samples as it has.
void expect_pixels_of_whole_pictures(const Scene& scene, RenderSettings s,
                                     const Image& image) {
  std::map<float, Image> whole;
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    const float count = image.find("spp.Y")->values[i];
    if (count == 0) continue;
    if (!whole.contains(count)) {
      s.samples_per_pixel = static_cast<uint32_t>(count);
      whole.emplace(count, render(scene, s).film.develop());
    }
    for (const char* name : {"R", "variance.G", "albedo.B", "depth.Z"})
      ASSERT_EQ(image.find(name)->values[i], whole.at(count).find(name)->values[i]);
  }
}

class TimeLimitTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, TimeLimitTest, testing::ValuesIn(integrator_names()));

// On one thread, passes over this picture take seconds.
TEST_P(TimeLimitTest, IsKeptAmidAPass) {
  const Vec2i resolution{2400, 1800};
  const Scene scene(foggy_ball(resolution));
  for (const int threads : {1, 7}) {
    const RenderResult result =
        render(scene, settings_of(resolution, GetParam()), within(0.5, threads));
    EXPECT_TRUE(result.statistics.stopped_early);
    EXPECT_GE(result.statistics.seconds, 0.5);
    EXPECT_LT(result.statistics.seconds, 2);
  }
}

TEST(TimeLimit, OneSampleOfEachPixelMayNotFit) {
  const Vec2i resolution{1200, 900};
  const Scene scene(foggy_ball(resolution));
  const RenderSettings s = settings_of(resolution, "volpath");
  const RenderResult result = render(scene, s, within(0.1, 1));
  const RenderStatistics& statistics = result.statistics;
  const int64_t pixels = 1200 * 900, sampled = pixels - statistics.unsampled_pixels;
  ASSERT_GT(statistics.unsampled_pixels, 0);
  EXPECT_GT(sampled, 0);
  EXPECT_EQ(statistics.samples_per_pixel, 0u);
  EXPECT_EQ(statistics.paths, sampled);
  ASSERT_EQ(statistics.notes.size(), 1u);
  EXPECT_TRUE(statistics.notes[0].starts_with("stopped before each pixel had a sample: " +
                                              std::to_string(statistics.unsampled_pixels) +
                                              " of 1080000 ("));
  EXPECT_TRUE(statistics.notes[0].ends_with(" %) show what a pixel nearby found"));
  const Image image = result.film.develop();
  expect_pixels_of_whole_pictures(scene, s, image);
  // Even the left upper corner's neighbor has something of it.
  for (const Channel& channel : image.channels())
    for (const float value : channel.values) ASSERT_TRUE(std::isfinite(value));
  EXPECT_GT(image.find("depth.Z")->values[1200 * 450 + 601], 0);
}

TEST(TimeLimit, PixelsAreDividedByTheirOwnNumbersOfSamples) {
  const Vec2i resolution{300, 200};
  const Scene scene(foggy_ball(resolution));
  const RenderSettings s = settings_of(resolution, "volpath");
  const RenderResult result = render(scene, s, within(0.5, 2));
  const Image image = result.film.develop();
  double samples = 0;
  float least = 1e9f;
  for (const float count : image.find("spp.Y")->values) {
    samples += double{count};
    least = std::min(least, count);
  }
  EXPECT_EQ(samples, static_cast<double>(result.statistics.paths));
  EXPECT_EQ(least, static_cast<float>(result.statistics.samples_per_pixel));
  expect_pixels_of_whole_pictures(scene, s, image);
}

// Passes that are long enough not to fit begin with all of the picture.
TEST(TimeLimit, PicturesWithinItAreTheSame) {
  const Vec2i resolution{70, 45};
  const Scene scene(foggy_ball(resolution));
  RenderSettings s = settings_of(resolution, "learned");
  s.samples_per_pixel = 5;
  const RenderResult limited = render(scene, s, within(1e6, 2));
  EXPECT_FALSE(limited.statistics.stopped_early);
  EXPECT_EQ(limited.statistics.unsampled_pixels, 0);
  EXPECT_EQ(limited.film.develop().find("G")->values,
            render(scene, s).film.develop().find("G")->values);
}

// What may happen to the first pass of a large picture.
TEST(TimeLimit, StoppingDoesNotWaitForThePass) {
  const Vec2i resolution{4000, 3000};
  const Scene scene(foggy_ball(resolution));
  std::atomic<bool> stop{false};
  RenderOptions options;
  options.threads = 2;
  options.stop = &stop;
  double stopped_at = infinity;
  options.on_progress = [&](const RenderProgress& progress) {
    if (!stop.exchange(true)) stopped_at = progress.seconds;
  };
  const RenderSettings s = settings_of(resolution, "volpath");
  const RenderResult result = render(scene, s, options);
  EXPECT_TRUE(result.statistics.stopped_early);
  EXPECT_LT(result.statistics.seconds, stopped_at + 1.5);
  EXPECT_GT(result.statistics.unsampled_pixels, 0);
  const Image image = result.film.develop();
  // In all parts of the picture.
  for (const float at : {0.1f, 0.5f, 0.9f}) {
    const auto row = static_cast<size_t>(at * 3000);
    const float* counts = &image.find("spp.Y")->values[4000 * row];
    int sampled = 0;
    for (int i = 0; i < 4000 * 32; ++i) sampled += counts[i] > 0 ? 1 : 0;
    EXPECT_GT(sampled, 0) << at;
  }
}

// Preparation that takes all of the time leaves some for the picture.
TEST(TimeLimit, SomethingIsSeenInNoTime) {
  const Vec2i resolution{1200, 900};
  const Scene scene(foggy_ball(resolution));
  const RenderResult result =
      render(scene, settings_of(resolution, "learned"), within(1e-9, 2));
  EXPECT_GT(result.statistics.paths, 0);
  EXPECT_LT(result.statistics.seconds, 2);
}

}  // namespace
}  // namespace tyndall
