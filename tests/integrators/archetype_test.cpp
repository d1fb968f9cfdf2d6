// SPDX-License-Identifier: Apache-2.0
// The archetype scenes beside the repository, against their references: means of tiles.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/statistical_tests.h"
#include "tyndall/image/io.h"
#include "tyndall/integrators/render.h"
#include "tyndall/loader/load_scene.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr int tile = 16;  // [pixels]
constexpr double level = 0.01;

const fs::path archetypes = fs::path(TYNDALL_SOURCE_DIR) / ".." / "shared/scenes/archetypes";

struct Case {
  std::string scene, file, reference;  // reference without extension
};

std::vector<Case> cases() {
  std::vector<Case> all;
  if (!fs::exists(archetypes)) return all;
  for (const fs::directory_entry& entry : fs::directory_iterator(archetypes)) {
    const std::string name = entry.path().filename().string();
    if (fs::exists(entry.path() / "reference.exr"))
      all.push_back({name, "scene.pbrt", "reference"});
    if (fs::exists(entry.path() / "reference-d2.exr"))
      all.push_back({name, "scene-d2.pbrt", "reference-d2"});
  }
  std::ranges::sort(all, {}, [](const Case& c) { return c.scene + c.file; });
  return all;
}

// Mean over a tile of the green channel and its standard error squared.
struct TileMean {
  double mean = 0, variance = 0;
};

// The error of a reference is known as relMSE = mean of error^2 / (r^2 + epsilon), so a pixel's
// variance is about relMSE * (r^2 + epsilon).
TileMean reference_tile(const Image& image, int x0, int y0, double relmse, double epsilon) {
  TileMean t;
  for (int y = y0; y < y0 + tile; ++y)
    for (int x = x0; x < x0 + tile; ++x) {
      const double r = double{image.rgb(x, y).g};
      t.mean += r / (tile * tile);
      t.variance += relmse * (r * r + epsilon) / (tile * tile) / (tile * tile);
    }
  return t;
}

TileMean rendered_tile(const Image& image, int x0, int y0) {
  TileMean t;
  for (int y = y0; y < y0 + tile; ++y)
    for (int x = x0; x < x0 + tile; ++x) {
      t.mean += double{image.rgb(x, y).g} / (tile * tile);
      t.variance += double{image.rgb(x, y, "variance").g} / (tile * tile) / (tile * tile);
    }
  return t;
}

std::string case_name(const testing::TestParamInfo<std::tuple<Case, std::string>>& info) {
  const auto& [c, integrator] = info.param;
  return c.scene + (c.reference == "reference" ? "_full_" : "_d2_") + integrator;
}

class ArchetypeTest : public testing::TestWithParam<std::tuple<Case, std::string>> {};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ArchetypeTest);
INSTANTIATE_TEST_SUITE_P(Scenes, ArchetypeTest,
                         testing::Combine(testing::ValuesIn(cases()),
                                          testing::ValuesIn(integrator_names())),
                         case_name);

TEST_P(ArchetypeTest, AgreesWithItsReference) {
  const auto& [c, integrator] = GetParam();
  LoadedScene loaded = load_scene((archetypes / c.scene / c.file).string());
  loaded.settings.integrator = integrator;
  loaded.settings.samples_per_pixel = 1'000'000;
  const Scene scene(std::move(loaded.scene));
  const RenderResult result = render(scene, loaded.settings, {.time_limit = 2.0});
  EXPECT_EQ(result.statistics.rejected.total(), 0);

  const Image image = result.film.develop();
  const Image reference = read_image((archetypes / c.scene / (c.reference + ".exr")).string());
  std::ifstream json_file(archetypes / c.scene / (c.reference + ".json"));
  const nlohmann::json json = nlohmann::json::parse(json_file);
  const double relmse = json.value("relmse_drop", 0.0);
  const double epsilon = 0.01 * sqr(json.value("mean", 1.0));

  const int tiles = (image.width() / tile) * (image.height() / tile);
  int rejected = 0;
  double difference = 0, variance = 0;
  for (int y = 0; y + tile <= image.height(); y += tile)
    for (int x = 0; x + tile <= image.width(); x += tile) {
      const TileMean a = rendered_tile(image, x, y);
      const TileMean b = reference_tile(reference, x, y, relmse, epsilon);
      // Rounding: both images are floats, and a furnace has no variance at all.
      const double error = std::sqrt(a.variance + b.variance + sqr(1e-5 * b.mean));
      if (z_p_value(a.mean - b.mean, error, 0) < sidak(level, tiles)) ++rejected;
      difference += a.mean - b.mean;
      variance += sqr(error);
    }
  EXPECT_EQ(rejected, 0) << "tiles of " << tiles;
  EXPECT_GT(z_p_value(difference, std::sqrt(variance), 0), 1e-4)
      << "all tiles together: " << difference / tiles << " +- " << std::sqrt(variance) / tiles;
}

}  // namespace
}  // namespace tyndall
