// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/render_arguments.h"

#include <gtest/gtest.h>

#include "apps/tyndall/memory_check.h"
#include "apps/tyndall/scene_input.h"

namespace tyndall::app {
namespace {

RenderSettings settings_of(Vec2i size) {
  RenderSettings settings;
  settings.resolution = size;
  settings.crop_max = size;
  return settings;
}

TEST(ApplyArguments, LeavesWhatIsNotAskedFor) {
  RenderSettings settings = settings_of({64, 32});
  settings.samples_per_pixel = 7;
  settings.seed = 3;
  apply(RenderArguments{}, settings);
  EXPECT_EQ(settings.samples_per_pixel, 7u);
  EXPECT_EQ(settings.seed, 3u);
  EXPECT_EQ(settings.crop_max, (Vec2i{64, 32}));
}

TEST(ApplyArguments, OverridesTheScene) {
  RenderSettings settings = settings_of({64, 32});
  RenderArguments arguments;
  arguments.samples_per_pixel = 9;
  arguments.sampler = "independent";
  arguments.assignments = {{"a.b", "1"}, {"a.b", "2"}, {"c", "x"}};
  apply(arguments, settings);
  EXPECT_EQ(settings.samples_per_pixel, 9u);
  EXPECT_EQ(settings.sampler, SamplerKind::independent);
  EXPECT_EQ(settings.options,
            (std::map<std::string, std::string>{{"a.b", "2"}, {"c", "x"}}));
}

TEST(ApplyArguments, SizeKeepsThePartThatTheSceneCrops) {
  RenderSettings settings = settings_of({64, 32});
  settings.crop_min = {32, 8};
  settings.crop_max = {48, 24};
  RenderArguments arguments;
  arguments.size = Vec2i{128, 16};
  apply(arguments, settings);
  EXPECT_EQ(settings.crop_min, (Vec2i{64, 4}));
  EXPECT_EQ(settings.crop_max, (Vec2i{96, 12}));
}

TEST(ApplyArguments, PixelIsCountedInTheNewSize) {
  RenderSettings settings = settings_of({64, 32});
  RenderArguments arguments;
  arguments.size = Vec2i{100, 100};
  arguments.pixel = Vec2i{99, 98};
  apply(arguments, settings);
  EXPECT_EQ(settings.crop_min, (Vec2i{99, 98}));
  EXPECT_EQ(settings.crop_max, (Vec2i{100, 99}));
}

std::string usage_error(const RenderArguments& arguments) {
  RenderSettings settings = settings_of({64, 32});
  try {
    apply(arguments, settings);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ApplyArguments, RefusesWindowsOutsideThePicture) {
  RenderArguments arguments;
  arguments.pixel = Vec2i{64, 0};
  EXPECT_EQ(usage_error(arguments), "--pixel: 64,0 lies outside the 64x32 picture");
  arguments.pixel.reset();
  arguments.crop = parse_crop("70,0,80,10");
  EXPECT_EQ(usage_error(arguments),
            "--crop: the window holds no pixel of the 64x32 picture");
}

TEST(CheckFilm, FitsOrSaysBothAmounts) {
  EXPECT_NO_THROW(check_film_fits({0, 0}, {1920, 1080}, int64_t{2} << 30));
  EXPECT_NO_THROW(check_film_fits({99999, 99999}, {100000, 100000}, int64_t{2} << 30));
  try {
    check_film_fits({0, 0}, {100000, 100000}, 8'000'000'000);
    FAIL() << "accepted";
  } catch (const ResourceError& error) {
    EXPECT_STREQ(error.what(),
                 "a film of 100000x100000 pixels needs 2320 GB, more than the 8 GB "
                 "of memory here; see --size and --crop");
  }
}

TEST(CheckFilm, SidesMayOverflowTogether) {
  EXPECT_THROW(check_film_fits({0, 0}, {2147483647, 2147483647}, INT64_MAX), ResourceError);
}

TEST(ResizedCamera, FollowsTheAspectUnlessTheSceneSetsTheWindow) {
  PerspectiveCamera::Settings settings;
  settings.screen_min_x = -2;
  settings.screen_max_x = 2;
  const PerspectiveCamera wide(settings, {200, 100});
  EXPECT_EQ(resized(wide, {200, 100}, {300, 100}).settings().screen_max_x, 3);
  EXPECT_EQ(resized(wide, {200, 100}, {100, 400}).settings().screen_max_y, 4);
  EXPECT_EQ(resized(wide, {100, 100}, {300, 100}).settings().screen_max_x, 2);
}

}  // namespace
}  // namespace tyndall::app
