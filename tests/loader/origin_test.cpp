// SPDX-License-Identifier: Apache-2.0
// Where the origin of a loaded scene's coordinates lies: at the camera, unless asked
// otherwise.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "parse.h"

namespace tyndall {
namespace {

using test::error_of;

void expect_near(Vec3 actual, Vec3 expected) {
  EXPECT_LT(distance(actual, expected), 1e-6f)
      << actual.x << ' ' << actual.y << ' ' << actual.z;
}

const std::string eye = "LookAt 0.3 0.2 -0.7  0.1 0.2 0.9  0 1 0\n";
const std::string grid =
    "MakeNamedMedium \"NAME\" \"string type\" \"uniformgrid\" \"float density\" 1\n";

std::string named(std::string text, const std::string& name) {
  return text.replace(text.find("NAME"), 4, name);
}

std::string translate(Vec3d by) {
  return fmt::format("Translate {} {} {}\n", by.x, by.y, by.z);
}

// The camera, then one of everything that has a place. All is moved by `offset`.
LoadedScene scene_at(Vec3d offset, const std::string& option = "",
                     const LoadOptions& options = {}) {
  const std::string there = translate(offset);
  return parse_scene(option + there + named(grid, "early") + "Identity\n" + eye +
                         translate(-offset) + "Camera \"perspective\"\nWorldBegin\n" +
                         "ObjectBegin \"near\" Shape \"sphere\" ObjectEnd\n" + there +
                         named(grid, "late") +
                         "LightSource \"point\" \"point3 from\" [0 1 0]\n"
                         "ObjectBegin \"far\" Shape \"trianglemesh\" \"point3 P\" [0 0 0 "
                         "1 0 0 0 1 0.1] ObjectEnd\n"
                         "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0.1]\n"
                         "Translate 0.1 0 0 Shape \"sphere\"\n"
                         "ObjectInstance \"near\"\n"
                         "Identity ObjectInstance \"far\"\n",
                     "test.pbrt", options);
}

Bounds3 bounds_of(const Medium& medium) {
  return medium.visit([](const auto& m) {
    if constexpr (requires { m.world_bounds(); })
      return m.world_bounds();
    else
      return Bounds3{};
  });
}

Vec3 center(const Surface& surface) {
  return std::get<Sphere>(surface.shape).world_from_sphere.point({0, 0, 0});
}

std::vector<Vec3> corners(const Surface& surface) {
  return std::get<TriangleMesh>(surface.shape).positions();
}

// Everything is where it should be, seen from the camera.
void expect_in_place(const SceneDescription& scene, Vec3 from) {
  expect_near(scene.camera.position(), Vec3{0.3f, 0.2f, -0.7f} - from);
  ASSERT_EQ(scene.media.size(), 2u);
  for (const Medium& medium : scene.media) {
    expect_near(bounds_of(medium).min, -from);
    expect_near(bounds_of(medium).max, Vec3{1, 1, 1} - from);
    EXPECT_FALSE(is_black(medium.at(Vec3{1e-5f, 0.5f, 0.5f} - from).sigma_s));
    EXPECT_TRUE(is_black(medium.at(Vec3{-1e-5f, 0.5f, 0.5f} - from).sigma_s));
  }
  expect_near(scene.lights.at(0).extent()->box.min, Vec3{0, 1, 0} - from);
  expect_near(corners(scene.surfaces.at(0)).at(2), Vec3{0, 1, 0.1f} - from);
  expect_near(center(scene.surfaces.at(1)), Vec3{0.1f, 0, 0} - from);
  const auto placed = [&](size_t i, Vec3 p) {
    return scene.instances.at(i).world_from_object.point(p);
  };
  expect_near(placed(0, center(scene.objects.at(0).at(0))), Vec3{0.1f, 0, 0} - from);
  expect_near(placed(1, corners(scene.objects.at(1).at(0)).at(2)), Vec3{0, 1, 0.1f} - from);
}

TEST(LoadOriginTest, IsTheCamera) {
  const SceneDescription scene = scene_at({}).scene;
  EXPECT_EQ(scene.camera.position(), (Vec3{0, 0, 0}));
  expect_near(to_float(scene.world_origin), {0.3f, 0.2f, -0.7f});
  expect_in_place(scene, {0.3f, 0.2f, -0.7f});
}

// In floats, the sums would be off by up to 0.03.
TEST(LoadOriginTest, LargeTranslationsCancel) {
  const SceneDescription scene = scene_at({300000.3, -20000.1, 7777.7}).scene;
  EXPECT_NEAR(scene.world_origin.x, 300000.6, 1e-9);
  EXPECT_NEAR(scene.world_origin.y, -19999.9, 1e-9);
  expect_in_place(scene, {0.3f, 0.2f, -0.7f});
}

TEST(LoadOriginTest, CanStayTheFiles) {
  for (const auto& loaded :
       {scene_at({}, "Option \"rendercoordsys\" \"world\"\n"),
        scene_at({}, "", {.strict = false, .on_warning = {}, .keeps_world = true})}) {
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(to_float(loaded.scene.world_origin), (Vec3{0, 0, 0}));
    expect_in_place(loaded.scene, {0, 0, 0});
  }
}

// A sphere of radius 1 about (-20, 0, 0), twice, seen from a distance.
LoadedScene seen_from(double distance, const std::string& option = "",
                      const WarningSink& on_warning = {}) {
  return parse_scene(option +
                         fmt::format("LookAt {} 0 0  -20 0 0  0 1 0\n", distance - 20) +
                         "Camera \"perspective\"\nFilm \"gbuffer\"\nWorldBegin\n"
                         "LightSource \"distant\"\n"
                         "Translate -20 0 0 Shape \"sphere\"\n"
                         "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd\n"
                         "Identity ObjectInstance \"o\"",
                     "test.pbrt", {.strict = false, .on_warning = on_warning});
}

// The radius of the box around a sphere of radius 1 is the root of 3.
TEST(LoadOriginTest, IsTheCenterOfShapesFarAway) {
  for (const double distance : {54.0, 1e3, 1e7}) {
    SCOPED_TRACE(distance);
    const bool is_far = distance > 32 * std::sqrt(3);
    for (const std::string option : {"", "Option \"rendercoordsys\" \"cameraworld\"\n"}) {
      int warnings = 0;
      const LoadedScene loaded =
          seen_from(distance, option, [&](const Diagnostic&) { ++warnings; });
      EXPECT_EQ(warnings, 1);  // also where the file is read twice
      EXPECT_EQ(loaded.warnings.size(), 1u);
      const SceneDescription& scene = loaded.scene;
      const bool is_centered = is_far && option.empty();
      const float x = is_centered ? 0 : static_cast<float>(-distance);
      const float slack = is_centered ? 1e-6f * static_cast<float>(distance) : 0;
      EXPECT_NEAR(center(scene.surfaces.at(0)).x, x, slack);
      EXPECT_NEAR(scene.instances.at(0)
                      .world_from_object.point(center(scene.objects.at(0).at(0)))
                      .x,
                  x, slack);
      EXPECT_NEAR(scene.camera.position().x, x + static_cast<float>(distance), slack);
      EXPECT_NEAR(scene.world_origin.x, is_centered ? -20 : distance - 20,
                  static_cast<double>(slack));
    }
  }
}

TEST(LoadOriginTest, ReadsPbrtsNames) {
  for (const std::string name : {"camera", "cameraworld"}) {
    const LoadedScene loaded = scene_at({}, "Option \"rendercoordsys\" \"" + name + "\"\n");
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.camera.position(), (Vec3{0, 0, 0}));
  }
  EXPECT_EQ(error_of("Option \"rendercoordsys\" \"lens\"\nCamera \"perspective\"\n"
                     "WorldBegin\nLightSource \"infinite\"\n"),
            "test.pbrt:1:1: error: Option \"rendercoordsys\" must be \"cameraworld\", "
            "\"camera\" or \"world\", got \"lens\"\n"
            "    1 | Option \"rendercoordsys\" \"lens\"\n"
            "      | ^~~~~~~~~~~~~~~~~~~~~~~");
}

// Directives that forget the transformation so far do not forget the origin.
TEST(LoadOriginTest, OutlivesTheTransformation) {
  for (const std::string back : {"Identity", "CoordSysTransform \"world\"",
                                 "Transform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1]"}) {
    const LoadedScene loaded =
        test::parse_world("Scale 3 3 3 " + back + " Shape \"sphere\"", eye);
    expect_near(center(loaded.scene.surfaces[0]), {-0.3f, -0.2f, 0.7f});
  }
}

TEST(LoadOriginTest, VerticesOfDoublesKeepTheirDigits) {
  const auto folder = std::filesystem::temp_directory_path() / "tyndall_origin_test";
  std::filesystem::create_directories(folder);
  for (const std::string type : {"float", "double"}) {
    std::ofstream(folder / "far.ply")
        << "ply\nformat ascii 1.0\nelement vertex 3\nproperty " << type << " x\nproperty "
        << type << " y\nproperty " << type
        << " z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
           "300000.3 0 0\n300001.3 0 0\n300000.3 1 0\n3 0 1 2\n";
    const LoadedScene loaded = test::parse_world(
        "Shape \"plymesh\" \"string filename\" \"" + (folder / "far.ply").string() + "\"",
        "Translate -300000 0 0\n");
    const float x = corners(loaded.scene.surfaces[0])[0].x;
    EXPECT_NEAR(x, type == "double" ? 0.3f : 300000.3f - 300000, 1e-7f) << type;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace tyndall
