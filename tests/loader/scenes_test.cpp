// SPDX-License-Identifier: Apache-2.0
// Whole scenes: those that the project is measured by, and those of other people.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "parse.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

const fs::path shared_scenes = TYNDALL_SOURCE_DIR "/../shared/scenes";

std::vector<std::string> scenes_below(const fs::path& folder) {
  std::vector<std::string> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().string();
    const bool is_whole = path.find("body.pbrt") == path.npos &&
                          path.find("density.pbrt") == path.npos &&
                          path.find("/source/") == path.npos;
    if (path.ends_with(".pbrt") && is_whole) scenes.push_back(path);
  }
  return scenes;
}

TEST(ArchetypeScenesTest, LoadWithoutWarnings) {
  if (!fs::exists(shared_scenes)) GTEST_SKIP() << "no shared scenes";
  const std::vector<std::string> scenes = scenes_below(shared_scenes / "archetypes");
  EXPECT_EQ(scenes.size(), 33u);
  for (const std::string& path : scenes) {
    SCOPED_TRACE(path);
    LoadedScene loaded;
    ASSERT_NO_THROW(loaded = load_scene(path, {.strict = true, .on_warning = {}}));
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.media.size(), 1u);
    EXPECT_EQ(loaded.settings.resolution, (Vec2i{128, 128}));
    EXPECT_EQ(loaded.settings.sampler, SamplerKind::independent);
    EXPECT_EQ(loaded.settings.filter.kind, FilterKind::box);
    EXPECT_EQ(loaded.settings.imaging_ratio, 1);
  }
}

TEST(WildScenesTest, Load) {
  if (!fs::exists(shared_scenes)) GTEST_SKIP() << "no shared scenes";
  for (const std::string& path : scenes_below(shared_scenes / "wild")) {
    SCOPED_TRACE(path);
    EXPECT_NO_THROW(load_scene(path));
  }
}

// Why a file that pbrt-v4's formatter accepts may be refused: files that are not there;
// what pbrt-v4 itself refuses when it renders; black pictures; and the one camera we lack.
bool is_excusable(const Diagnostic& error) {
  const std::vector<std::string> messages{
      "the scene has no lights: the picture would be black",
      "Camera \"orthographic\": this camera is not supported; there is \"perspective\"",
      "Integrator \"toon\": there is no such integrator",
      "Shape \"bilinearPatch\": there is no such shape",
      "Shape \"lsystem\": there is no such shape",
      "Shape \"box\": there is no such shape",
      "Shape \"sphere\": unknown parameter \"center\"",
  };
  const bool is_missing_file = error.message.starts_with("cannot read \"") &&
                               error.message.ends_with("\": No such file or directory");
  return is_missing_file ||
         std::any_of(messages.begin(), messages.end(), [&](const std::string& message) {
           return error.message.starts_with(message);
         });
}

struct Expectation {
  std::string path;
  bool is_fragment, is_accepted;
};

std::vector<Expectation> read_expectations(const fs::path& table) {
  std::vector<Expectation> expectations;
  std::ifstream in(table);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream columns(line);
    std::string path, bytes, kind, license, result;
    std::getline(columns, path, '\t');
    std::getline(columns, bytes, '\t');
    std::getline(columns, kind, '\t');
    std::getline(columns, license, '\t');
    std::getline(columns, result, '\t');
    expectations.push_back({path, kind == "fragment", result == "ok"});
  }
  return expectations;
}

LoadedScene load(const fs::path& path, bool is_fragment) {
  if (!is_fragment) return load_scene(path.string());
  return parse_scene(
      "Camera \"perspective\" WorldBegin LightSource \"infinite\" Include \"" +
          path.filename().string() + "\"",
      (path.parent_path() / "frame.pbrt").string());
}

TEST(ParserCorpusTest, AgreesWithPbrt) {
  const fs::path folder = shared_scenes / "parser/v4";
  if (!fs::exists(folder)) GTEST_SKIP() << "no shared scenes";
  size_t loaded = 0;
  const std::vector<Expectation> expectations = read_expectations(folder / "EXPECTED.tsv");
  EXPECT_EQ(expectations.size(), 124u);
  for (const Expectation& expected : expectations) {
    SCOPED_TRACE(expected.path);
    try {
      load(folder / expected.path, expected.is_fragment);
      EXPECT_TRUE(expected.is_accepted);
      ++loaded;
    } catch (const SceneError& error) {
      for (const Diagnostic& diagnostic : error.diagnostics())
        EXPECT_TRUE(!expected.is_accepted || is_excusable(diagnostic)) << diagnostic.text;
    }
  }
  EXPECT_GE(loaded, 75u);  // most of the others name files that are not here
}

}  // namespace
}  // namespace tyndall
