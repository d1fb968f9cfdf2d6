// SPDX-License-Identifier: Apache-2.0
// Media whose grids stand in files of their own.
#include <gtest/gtest.h>

#include "image/temporary_folder.h"
#include "parse.h"
#include "support/volume_writer.h"
#include "tyndall/media/blackbody.h"

namespace tyndall {
namespace {

constexpr Vec3 center{3.5f, 3.5f, 3.5f};

std::vector<test::TestVoxel> cube(float value) {
  return test::filled_box({0, 0, 0}, {7, 7, 7}, value);
}

void expect_near(Rgb actual, Rgb expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-5f * expected[i]) << i;
}

// A scene with a medium of a file in a folder of its own.
class LoadVolumeTest : public testing::Test {
 protected:
  std::string path(const std::string& name = "v.nvdb") const { return folder_.file(name); }

  // `file` is the file's name; `parameters` follow it.
  LoadedScene load(const std::string& parameters, const std::string& file = "v.nvdb",
                   const std::string& before = "") const {
    return parse_scene("Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n" +
                           before + "MakeNamedMedium \"m\" \"string type\" \"nanovdb\"\n" +
                           "\"string filename\" \"" + file + "\" " + parameters,
                       folder_.file("scene.pbrt"));
  }
  Medium medium(const std::string& parameters, const std::string& file = "v.nvdb") const {
    const LoadedScene loaded = load(parameters, file);
    EXPECT_EQ(loaded.warnings.size(), 0u);
    return loaded.scene.media.at(0);
  }
  // The sentence that is said of the medium, without the folder's name.
  std::string complaint(const std::string& parameters,
                        const std::string& file = "v.nvdb") const {
    std::string text;
    try {
      const LoadedScene loaded = load(parameters, file);
      for (const Diagnostic& warning : loaded.warnings) text += warning.message;
    } catch (const SceneError& error) {
      for (const Diagnostic& d : error.diagnostics()) text += d.message;
    }
    const std::string folder = folder_.file("");
    for (size_t at = 0; (at = text.find(folder, at)) != text.npos;)
      text.erase(at, folder.size());
    const std::string owner = "MakeNamedMedium \"m\": ";
    return text.starts_with(owner) ? text.substr(owner.size()) : text;
  }

 private:
  const TemporaryFolder folder_;
};

TEST_F(LoadVolumeTest, DensityScalesCoefficients) {
  test::write_nvdb(path(), {{.voxels = cube(2)}});
  const Medium unit = medium("");
  expect_near(unit.at(center).sigma_a, Rgb(2));
  expect_near(unit.at(center).sigma_s, Rgb(2));
  EXPECT_FALSE(unit.is_emissive());
  EXPECT_TRUE(is_black(unit.at({9, 3, 3}).sigma_s));
  const Medium scaled = medium(
      "\"rgb sigma_a\" [1 2 3] \"float sigma_s\" 0 \"float scale\" 10 \"float g\" .25");
  expect_near(scaled.at(center).sigma_a, {20, 40, 60});
  EXPECT_EQ(scaled.phase().mean_cosine(), 0.25f);
  const Medium milk = medium("\"string preset\" \"Skin1\"");
  expect_near(milk.at(center).sigma_s, {1.48f, 1.76f, 2.02f});
}

TEST_F(LoadVolumeTest, BothFilesAndBothNamesOfTheTypeAreTheSame) {
  if (!test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  const std::vector<test::TestGrid> grids{
      {.voxels = cube(2), .voxel_size = 0.5, .origin = {10, 0, 0}}};
  test::write_nvdb(path(), grids);
  test::write_vdb(path("v.vdb"), grids);
  for (const char* file : {"v.nvdb", "v.vdb"}) {
    SCOPED_TRACE(file);
    const Medium m = medium("", file);
    expect_near(m.at({11.75f, 1.75f, 1.75f}).sigma_s, Rgb(2));
    // Between the last voxel and the empty one next to it.
    expect_near(m.at({13.75f, 1.75f, 1.75f}).sigma_s, Rgb(1));
  }
  const LoadedScene alias = parse_scene(
      "Camera \"perspective\" WorldBegin LightSource \"infinite\" MakeNamedMedium \"m\" "
      "\"string type\" \"openvdb\" \"string filename\" \"v.vdb\"",
      path("scene.pbrt"));
  expect_near(alias.scene.media.at(0).at({11.75f, 1.75f, 1.75f}).sigma_s, Rgb(2));
}

TEST_F(LoadVolumeTest, TransformsApply) {
  test::write_nvdb(path(), {{.voxels = cube(2)}});
  const Medium m = load("", "v.nvdb", "Translate 0 100 0 Rotate 90 0 0 1 Scale 2 2 -2 ")
                       .scene.media.at(0);
  // (3.5, 3.5, 3.5) -> (7, 7, -7) -> (-7, 7, -7) -> (-7, 107, -7)
  expect_near(m.at({-7, 107, -7}).sigma_s, Rgb(2));
  EXPECT_TRUE(is_black(m.at({-7, 107, 7}).sigma_s));
}

TEST_F(LoadVolumeTest, GridsAreChosenByName) {
  test::write_nvdb(path(), {{.name = "smoke", .voxels = cube(2)},
                            {.name = "density", .voxels = cube(3)},
                            {.name = "hot", .voxels = cube(1)}});
  expect_near(medium("").at(center).sigma_s, Rgb(3));
  expect_near(medium("\"string gridname\" \"smoke\"").at(center).sigma_s, Rgb(2));
  const Medium glowing =
      medium("\"string temperaturename\" \"hot\" \"float temperaturescale\" 3000");
  expect_near(glowing.at(center).Le, blackbody_radiance(3000));
}

TEST_F(LoadVolumeTest, TemperatureMakesItGlow) {
  for (const char* name : {"temperature", "flame", "flames", "heat"}) {
    SCOPED_TRACE(name);
    test::write_nvdb(path(), {{.voxels = cube(2)}, {.name = name, .voxels = cube(1.5f)}});
    const Medium m = medium(
        "\"float temperaturescale\" 2000 \"float temperatureoffset\" .5 \"float Lescale\" "
        "3");
    EXPECT_TRUE(m.is_emissive());
    expect_near(m.at(center).Le, 3 * blackbody_radiance(2000));
  }
}

TEST_F(LoadVolumeTest, TemperatureComesBeforeFlameAndHeat) {
  if (!test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  test::write_vdb(path("v.vdb"), {{.name = "heat", .voxels = cube(1)},
                                  {.name = "flame", .voxels = cube(2)},
                                  {.name = "temperature", .voxels = cube(3)},
                                  {.voxels = cube(2)}});
  const Medium m = medium("\"float temperaturescale\" 1000", "v.vdb");
  expect_near(m.at(center).Le, blackbody_radiance(3000));
}

// Beyond pbrt-v4: a constant Le, in place of a temperature that the file may hold.
TEST_F(LoadVolumeTest, LeIsScaledByLescale) {
  test::write_nvdb(path(),
                   {{.voxels = cube(2)}, {.name = "temperature", .voxels = cube(1500)}});
  const Medium m = medium("\"rgb Le\" [1 2 3] \"float Lescale\" 2");
  expect_near(m.at(center).Le, {2, 4, 6});
  EXPECT_EQ(complaint("\"float Le\" 1 \"string temperaturename\" \"temperature\""),
            "either \"Le\" or a temperature says how the medium glows");
}

TEST_F(LoadVolumeTest, WhatIsMissingIsNamed) {
  test::write_nvdb(
      path(), {{.name = "smoke", .voxels = cube(2)}, {.name = "heat", .voxels = cube(2)}});
  EXPECT_EQ(complaint(""),
            "cannot read v.nvdb: there is no grid \"density\"; the file has \"smoke\" "
            "(float), \"heat\" (float)");
  EXPECT_EQ(complaint("\"string gridname\" \"smoke\" \"string temperaturename\" \"t\""),
            "cannot read v.nvdb: there is no grid \"t\"; the file has \"smoke\" (float), "
            "\"heat\" (float)");
  EXPECT_EQ(
      complaint("\"string gridname\" \"smoke\""),
      "the temperature reaches 2 K, too cold to glow; \"temperaturescale\" multiplies "
      "it");
}

TEST_F(LoadVolumeTest, OddDensitiesGetAWarning) {
  const auto with = [&](float value) {
    std::vector<test::TestVoxel> voxels = cube(2);
    voxels[100].value = value;
    test::write_nvdb(path(), {{.voxels = voxels}});
    return complaint("");
  };
  const std::string no_number =
      "the density grid holds values that are no numbers or above 1e+30, which count as "
      "zero";
  EXPECT_EQ(with(2e30f), no_number);
  EXPECT_EQ(with(-1),
            "the density grid holds values that are negative, which count as zero");
  EXPECT_EQ(with(std::numeric_limits<float>::infinity()), no_number);
  EXPECT_EQ(with(std::numeric_limits<float>::quiet_NaN()), no_number);
  test::write_nvdb(path(), {{.voxels = cube(0)}});
  EXPECT_EQ(complaint(""), "the density is zero everywhere: an empty medium");
  if (!test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  test::write_vdb(path("v.vdb"), {{.voxels = {}}});
  EXPECT_EQ(complaint("", "v.vdb"), "the density is zero everywhere: an empty medium");
}

TEST_F(LoadVolumeTest, LevelSetsGetAWarning) {
  test::write_nvdb(path(), {test::level_set_of_ball(8, 3)});
  EXPECT_EQ(complaint(""),
            "the grid is a level set: the density is one inside its surface, and fades to "
            "zero there");
}

TEST_F(LoadVolumeTest, GridsWithoutNumbersAreRefused) {
  if (!test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  test::write_vdb_without_numbers(path("v.vdb"));
  EXPECT_EQ(complaint("\"string gridname\" \"points\"", "v.vdb"),
            "cannot read v.vdb: grid \"points\" is of type points, a grid of numbers is "
            "needed; the file has \"points\" (points), \"v\" (vec3s)");
}

}  // namespace
}  // namespace tyndall
