// SPDX-License-Identifier: Apache-2.0
// The loop around the integrators: determinism, stopping, progress.
#include <gtest/gtest.h>

#include <atomic>

#include "scenes.h"

namespace tyndall {
namespace {

SceneDescription foggy_scene() {
  SceneDescription d;
  d.camera = test::camera({0, 0, -3}, {0, 0, 0}, 40, {40, 30});
  d.media.push_back(test::grey_fog(1, 0.1f, 0.4f));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.surfaces.push_back(test::diffuse_disk(1.5f, 3, 0.5f));
  d.lights.push_back(Light(PointLight{{0.5f, 0.9f, -1.5f}, Rgb(5)}));
  d.lights.push_back(Light(ConstantEnvironment{Rgb(0.1f)}));
  return d;
}

RenderSettings foggy_settings(const std::string& integrator) {
  RenderSettings s = test::settings(integrator, 6);
  s.sampler = SamplerKind::sobol;
  s.resolution = s.crop_max = {40, 30};
  s.samples_per_pixel = 9;
  return s;
}

void expect_same(const Image& a, const Image& b) {
  ASSERT_EQ(a.channels().size(), b.channels().size());
  for (size_t i = 0; i < a.channels().size(); ++i)
    EXPECT_EQ(a.channels()[i].values, b.channels()[i].values) << a.channels()[i].name;
}

RenderOptions with_threads(int threads) {
  RenderOptions options;
  options.threads = threads;
  return options;
}

class RenderTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, RenderTest, testing::ValuesIn(integrator_names()));

TEST_P(RenderTest, SameImageForAnyNumberOfThreads) {
  const Scene scene(foggy_scene());
  const RenderSettings s = foggy_settings(GetParam());
  const RenderResult one = render(scene, s, with_threads(1));
  EXPECT_EQ(one.statistics.samples_per_pixel, 9u);
  EXPECT_EQ(one.statistics.rejected.total(), 0);
  EXPECT_GT(one.film.develop().rgb(20, 15).r, 0);
  for (const int threads : {2, 7})
    expect_same(one.film.develop(), render(scene, s, with_threads(threads)).film.develop());
}

TEST_P(RenderTest, CropIsPartOfTheFullPicture) {
  const Scene scene(foggy_scene());
  RenderSettings s = foggy_settings(GetParam());
  const Image full = render(scene, s).film.develop();
  s.crop_min = {10, 5};
  s.crop_max = {21, 17};
  const Image crop = render(scene, s).film.develop();
  if (GetParam() == "volpath") {  // integrators that learn, learn from what they see
    for (int y = 5; y < 17; ++y)
      for (int x = 10; x < 21; ++x) EXPECT_EQ(full.rgb(x, y), crop.rgb(x - 10, y - 5));
  }
  EXPECT_EQ(crop.width(), 11);
  EXPECT_EQ(crop.height(), 12);
}

// pbrt-v4 multiplies what the sensor sees by exposure time * iso / 100.
TEST(Render, MultipliesByTheImagingRatio) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -3}, {0, 0, 0}, 40, {8, 8});
  d.lights.push_back(Light(ConstantEnvironment{Rgb(0.25f, 0.5f, 1)}));
  RenderSettings s = test::settings("volpath", 6);
  s.resolution = s.crop_max = {8, 8};
  s.imaging_ratio = 4;
  const Image image = render(Scene(d), s).film.develop();
  EXPECT_EQ(image.rgb(3, 5), Rgb(1, 2, 4));
}

// As pbrt-v4's film: after the imaging ratio, before the filter, by the largest component.
TEST(Render, DimsSamplesToTheMaximumComponent) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -3}, {0, 0, 0}, 40, {8, 8});
  d.lights.push_back(Light(ConstantEnvironment{Rgb(0.25f, 0.5f, 1)}));
  const Scene scene(std::move(d));
  RenderSettings s = test::settings("volpath", 6);
  s.resolution = s.crop_max = {8, 8};
  s.imaging_ratio = 4;
  for (const auto& [maximum, expected] :
       {std::pair(2.0f, Rgb(0.5f, 1, 2)), std::pair(4.0f, Rgb(1, 2, 4))}) {
    s.max_component = maximum;
    EXPECT_EQ(render(scene, s).film.develop().rgb(3, 5), expected) << maximum;
  }
}

TEST_P(RenderTest, ImagingRatioScalesVarianceAndNotGuides) {
  const Scene scene(foggy_scene());
  RenderSettings s = foggy_settings(GetParam());
  const Image plain = render(scene, s).film.develop();
  s.imaging_ratio = 4;  // a power of two: rounding stays the same
  const Image bright = render(scene, s).film.develop();
  const auto expect_factor = [&](const std::string& channel, float factor) {
    std::vector<float> expected = plain.find(channel)->values;
    for (float& value : expected) value *= factor;
    EXPECT_EQ(bright.find(channel)->values, expected) << channel;
  };
  expect_factor("G", 4);
  expect_factor("variance.G", 16);
  for (const std::string name : {"albedo.G", "normal.Z", "depth.Z", "spp.Y"})
    expect_factor(name, 1);
}

TEST(Render, StopsAfterThePassInHand) {
  const Scene scene(foggy_scene());
  RenderSettings s = foggy_settings("volpath");
  s.samples_per_pixel = 1'000'000;
  std::atomic<bool> stop = false;
  RenderOptions options;
  options.stop = &stop;
  options.on_pass = [&](const Film&, uint32_t samples) { stop = samples >= 3; };
  const RenderResult result = render(scene, s, options);
  EXPECT_TRUE(result.statistics.stopped_early);
  EXPECT_GE(result.statistics.samples_per_pixel, 3u);
  const Image image = result.film.develop();
  EXPECT_EQ(image.find("spp.Y")->values[0],
            static_cast<float>(result.statistics.samples_per_pixel));
}

TEST(Render, ReportsProgressThatGrows) {
  const Scene scene(foggy_scene());
  RenderSettings s = foggy_settings("volpath");
  s.samples_per_pixel = 300;
  double last = 0;
  int calls = 0;
  RenderOptions options;
  options.on_progress = [&](const RenderProgress& p) {
    EXPECT_GE(p.fraction, last);
    EXPECT_LE(p.fraction, 1);
    EXPECT_GE(p.seconds_remaining, 0);
    last = p.fraction;
    ++calls;
  };
  render(scene, s, options);
  EXPECT_GT(calls, 0);
  EXPECT_EQ(last, 1);
}

TEST(Render, UnknownIntegratorNamesTheKnownOnes) {
  const Scene scene(foggy_scene());
  try {
    render(scene, foggy_settings("volpth"));
    FAIL() << "no exception";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("unknown integrator \"volpth\""),
              std::string::npos);
    EXPECT_NE(std::string(e.what()).find("volpath"), std::string::npos);
  }
}

}  // namespace
}  // namespace tyndall
