// SPDX-License-Identifier: Apache-2.0
// Camera, film, filter, sampler, integrator.
#include <gtest/gtest.h>

#include "parse.h"

namespace tyndall {
namespace {

using test::parse_options;

PerspectiveCamera::Settings camera_of(const std::string& text) {
  return parse_scene(text + "\nWorldBegin\nLightSource \"infinite\"\n", "test.pbrt",
                     {.strict = false, .on_warning = {}, .keeps_world = true})
      .scene.camera.settings();
}

TEST(LoadCameraTest, ScreenWindowFollowsTheFilm) {
  const std::string film =
      "Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100\n";
  const auto wide = camera_of("Camera \"perspective\"\n" + film);
  EXPECT_EQ(wide.screen_min_x, -2);
  EXPECT_EQ(wide.screen_max_x, 2);
  EXPECT_EQ(wide.screen_max_y, 1);
  const auto tall =
      camera_of(film + "Camera \"perspective\" \"float frameaspectratio\" .5");
  EXPECT_EQ(tall.screen_max_x, 1);
  EXPECT_EQ(tall.screen_min_y, -2);
  const auto given = camera_of("Camera \"perspective\" \"float screenwindow\" [-1 3 -4 5]");
  EXPECT_EQ(given.screen_min_x, -1);
  EXPECT_EQ(given.screen_max_x, 3);
  EXPECT_EQ(given.screen_min_y, -4);
  EXPECT_EQ(given.screen_max_y, 5);
}

TEST(LoadCameraTest, HasPbrtsDefaults) {
  const auto camera = camera_of("Camera \"perspective\"");
  EXPECT_EQ(camera.fov, 90);
  EXPECT_EQ(camera.lens_radius, 0);
  EXPECT_EQ(camera.focal_distance, 1e6f);
  EXPECT_EQ(camera_of("Camera \"perspective\" \"float halffov\" 20").fov, 40);
}

TEST(LoadCameraTest, LooksAlongItsZ) {
  const auto camera = camera_of("LookAt 1 2 3  1 2 10  0 1 0\nCamera \"perspective\"");
  const Vec3 eye = camera.world_from_camera.point({0, 0, 0});
  EXPECT_EQ(eye, (Vec3{1, 2, 3}));
  EXPECT_EQ(camera.world_from_camera.vector({0, 0, 1}), (Vec3{0, 0, 1}));
}

TEST(LoadCameraTest, IsSurroundedByTheOutsideMedium) {
  const LoadedScene loaded = parse_options(
      "MakeNamedMedium \"a\" \"string type\" \"homogeneous\"\n"
      "MakeNamedMedium \"b\" \"string type\" \"homogeneous\"\nMediumInterface \"a\" \"b\"");
  EXPECT_EQ(loaded.scene.camera_medium, 1);
  EXPECT_EQ(parse_options("").scene.camera_medium, no_medium);
}

TEST(LoadFilmTest, ReadsResolutionAndCrop) {
  const RenderSettings settings =
      parse_options(
          "Film \"rgb\" \"integer xresolution\" 101 \"integer yresolution\" 50 "
          "\"float cropwindow\" [.5 1 .25 .5] \"string filename\" \"a.exr\"")
          .settings;
  EXPECT_EQ(settings.resolution, (Vec2i{101, 50}));
  EXPECT_EQ(settings.crop_min, (Vec2i{51, 13}));  // rounded up, as in pbrt-v4
  EXPECT_EQ(settings.crop_max, (Vec2i{101, 25}));
  EXPECT_EQ(settings.output, "a.exr");
  const RenderSettings bounds =
      parse_options("Film \"rgb\" \"integer pixelbounds\" [10 20 30 4000]").settings;
  EXPECT_EQ(bounds.crop_min, (Vec2i{10, 30}));
  EXPECT_EQ(bounds.crop_max, (Vec2i{20, 720}));
  EXPECT_EQ(parse_options("").settings.crop_max, (Vec2i{1280, 720}));
}

TEST(LoadFilmTest, DerivesTheImagingRatio) {
  EXPECT_EQ(parse_options("").settings.imaging_ratio, 1);
  EXPECT_EQ(parse_options("Film \"rgb\" \"string sensor\" \"cie1931\" \"float iso\" 100")
                .settings.imaging_ratio,
            1);
  const std::string shutter =
      "Camera \"perspective\" \"float shutteropen\" .25 \"float shutterclose\" .75\n";
  const std::string film = "Film \"rgb\" \"float iso\" 400\n";
  for (const std::string& options : {shutter + film, film + shutter})
    EXPECT_EQ(parse_scene(options + "WorldBegin\nLightSource \"infinite\"\n", "test.pbrt")
                  .settings.imaging_ratio,
              2);
}

TEST(LoadFilmTest, ReadsTheMaximumComponent) {
  EXPECT_EQ(parse_options("").settings.max_component, infinity);
  EXPECT_EQ(
      parse_options("Film \"rgb\" \"float maxcomponentvalue\" 2.5").settings.max_component,
      2.5f);
}

TEST(LoadFilterTest, HasPbrtsDefaults) {
  const auto filter = [](const std::string& text) {
    return parse_options(text).settings.filter;
  };
  EXPECT_EQ(filter("").kind, FilterKind::gaussian);
  EXPECT_EQ(filter("").radius, (Vec2{1.5f, 1.5f}));
  EXPECT_EQ(filter("PixelFilter \"box\"").radius, (Vec2{0.5f, 0.5f}));
  EXPECT_EQ(filter("PixelFilter \"triangle\"").radius, (Vec2{2, 2}));
  EXPECT_EQ(filter("PixelFilter \"mitchell\" \"float B\" .1").b, 0.1f);
  EXPECT_EQ(filter("PixelFilter \"gaussian\" \"float sigma\" .3").sigma, 0.3f);
  EXPECT_EQ(filter("PixelFilter \"sinc\" \"float xradius\" 4").kind, FilterKind::mitchell);
}

TEST(LoadSamplerTest, MapsPbrtsSamplers) {
  const auto settings = [](const std::string& text) {
    return parse_options(text).settings;
  };
  EXPECT_EQ(settings("").samples_per_pixel, 16u);
  EXPECT_EQ(settings("Sampler \"independent\"").sampler, SamplerKind::independent);
  for (const std::string name : {"halton", "paddedsobol", "zsobol", "sobol", "pmj02bn"}) {
    const RenderSettings s =
        settings("Sampler \"" + name + "\" \"integer pixelsamples\" 77");
    EXPECT_EQ(s.sampler, SamplerKind::sobol);
    EXPECT_EQ(s.samples_per_pixel, 77u);
  }
  EXPECT_EQ(settings("Sampler \"stratified\" \"integer xsamples\" 5").samples_per_pixel,
            20u);
  EXPECT_EQ(settings("Sampler \"sobol\" \"integer seed\" 9").seed, 9u);
  EXPECT_EQ(settings("Option \"seed\" 42").seed, 42u);
}

TEST(LoadIntegratorTest, KeepsTheDepthAndTheDefaultIntegrator) {
  const std::string standard = RenderSettings{}.integrator;
  for (const std::string name : {"volpath", "simplevolpath", "path", "simplepath", "bdpt",
                                 "mlt", "sppm", "lightpath", "randomwalk"}) {
    const RenderSettings s =
        parse_options("Integrator \"" + name + "\" \"integer maxdepth\" 13").settings;
    EXPECT_EQ(s.max_depth, 13) << name;
    EXPECT_EQ(s.integrator, standard) << name;
  }
  EXPECT_EQ(parse_options("Integrator \"volpath\"").settings.max_depth, 5);
}

}  // namespace
}  // namespace tyndall
