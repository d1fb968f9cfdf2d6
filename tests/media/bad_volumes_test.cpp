// SPDX-License-Identifier: Apache-2.0
// Volume files that are empty, damaged, absurd or huge: an error that says what is wrong,
// or a medium that makes sense.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "image/temporary_folder.h"
#include "support/volume_writer.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/media/ratio_tracking.h"
#include "tyndall/media/volume_file.h"

namespace tyndall {
namespace {

constexpr std::string_view density[] = {"density"};

// The four kinds of file that there are: a writer and a name.
struct Format {
  const char* name;
  void (*write)(const std::string& path, const std::vector<test::TestGrid>& grids);
};
const Format formats[] = {
    {"v.vdb", [](const std::string& p, const auto& g) { test::write_vdb(p, g); }},
    {"none.nvdb", [](const std::string& p, const auto& g) { test::write_nvdb(p, g); }},
    {"zip.nvdb", [](const std::string& p,
                    const auto& g) { test::write_nvdb(p, g, test::NvdbCodec::zip); }},
    {"blosc.nvdb", [](const std::string& p,
                      const auto& g) { test::write_nvdb(p, g, test::NvdbCodec::blosc); }},
};

class BadVolumeTest : public testing::TestWithParam<Format> {
 protected:
  void SetUp() override {
    if (path().ends_with(".vdb") && !test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  }
  std::string path() const { return folder_.file(GetParam().name); }
  void write(const std::vector<test::TestGrid>& grids) const {
    GetParam().write(path(), grids);
  }
  PlacedGrid read() const { return read_volume(path(), density); }
  std::string complaint() const {
    const std::string text = message_of([&] { read(); });
    const std::string start = path() + ": ";
    return text.starts_with(start) ? text.substr(start.size()) : text;
  }

 private:
  TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Formats, BadVolumeTest, testing::ValuesIn(formats),
                         [](const auto& instance) {
                           std::string name = instance.param.name;
                           return name.substr(0, name.find('.'));
                         });

GridMedium medium_of(const PlacedGrid& grid, float sigma = 1) {
  return {grid, Transform(), {Rgb(0), Rgb(sigma), {}}, IsotropicPhase{}};
}

float transmittance(const GridMedium& medium, const Ray& ray) {
  RandomStream rng(1);
  double sum = 0;
  for (int i = 0; i < 1000; ++i)
    sum += double{ratio_tracking(medium, ray, infinity, rng).r};
  return static_cast<float>(sum / 1000);
}

const Ray along_x{{-100, 4, 4}, {1, 0, 0}};

TEST_P(BadVolumeTest, EmptyGridsAreEmptyMedia) {
  write({{.voxels = {}}});
  EXPECT_TRUE(read().grid->is_empty());
  EXPECT_EQ(transmittance(medium_of(read()), along_x), 1);
}

TEST_P(BadVolumeTest, NegativeGridsAreEmptyMedia) {
  write({{.voxels = test::filled_box({0, 0, 0}, {9, 9, 9}, -3)}});
  EXPECT_TRUE(read().grid->is_empty());
  EXPECT_GT(read().grid->rejected().negative, 999u);
  EXPECT_EQ(transmittance(medium_of(read()), along_x), 1);
}

TEST_P(BadVolumeTest, NumbersThatAreNoneCountAsZero) {
  for (const float bad : {std::nanf(""), infinity, -infinity, 1e35f}) {
    std::vector<test::TestVoxel> voxels = test::filled_box({0, 0, 0}, {9, 9, 9}, bad);
    voxels.push_back({{4, 4, 4}, 2});
    write({{.voxels = voxels}});
    const PlacedGrid grid = read();
    EXPECT_EQ(grid.grid->maximum(), 2);
    EXPECT_GT(grid.grid->rejected().not_finite, 998u);
    // A tent of height two and base two.
    EXPECT_NEAR(transmittance(medium_of(grid), along_x), std::exp(-2.0), 0.03);
  }
}

TEST_P(BadVolumeTest, ValuesThatAreNoNumbersHaveNoRange) {
  write({{.voxels = test::filled_box({0, 0, 0}, {9, 9, 9}, std::nanf(""))}});
  const VolumeGridInfo info = list_volume_grids(path()).at(0);
  EXPECT_EQ(info.active_voxels, 1000u);
  EXPECT_TRUE(std::isnan(info.min) && std::isnan(info.max)) << info.min << info.max;
}

// Voxels are cubes about their positions, whatever the format; densities interpolate
// between the positions, and fade to zero over half a voxel farther.
TEST_P(BadVolumeTest, BoundsAreThoseOfTheVoxels) {
  write({{.voxels = test::filled_box({-1, 0, 2}, {9, 9, 9}, 3),
          .voxel_size = 0.5,
          .origin = {10, 20, 30}}});
  const VolumeGridInfo info = list_volume_grids(path()).at(0);
  EXPECT_EQ(info.bounds.min, (Vec3{9.25f, 19.75f, 30.75f}));
  EXPECT_EQ(info.bounds.max, (Vec3{14.75f, 24.75f, 34.75f}));
  const GridMedium medium = medium_of(read());
  EXPECT_NEAR(medium.at(info.bounds.min + Vec3{0, 1, 1}).sigma_s.r, 1.5f, 1e-4f);
  EXPECT_EQ(medium.at(info.bounds.min + Vec3{-0.26f, 1, 1}).sigma_s.r, 0);
}

// A ball of which only a band about its surface is stored: one within, and a slope.
TEST_P(BadVolumeTest, LevelSetsBecomeDensities) {
  write({test::level_set_of_ball(20, 3)});
  const PlacedGrid grid = read();
  EXPECT_TRUE(grid.is_from_level_set);
  EXPECT_TRUE(list_volume_grids(path()).at(0).is_level_set);
  EXPECT_EQ(grid.grid->rejected().negative, 0u);
  const GridMedium medium = medium_of(grid);
  for (const float r : {0.0f, 10.0f, 16.0f, 17.0f})
    EXPECT_NEAR(medium.at({r, 0, 0}).sigma_s.r, 1, 1e-4f) << r;
  EXPECT_NEAR(medium.at({18, 0, 0}).sigma_s.r, 2.0f / 3, 1e-4f);
  EXPECT_NEAR(medium.at({0, 0, -19}).sigma_s.r, 1.0f / 3, 1e-4f);
  for (const float r : {20.0f, 21.0f, 25.0f})
    EXPECT_EQ(medium.at({0, r, 0}).sigma_s.r, 0) << r;
}

// The first is read, and nothing is printed.
TEST_P(BadVolumeTest, NamesMayBeThereTwice) {
  write({{.voxels = test::filled_box({0, 0, 0}, {9, 9, 9}, 2)},
         {.voxels = test::filled_box({0, 0, 0}, {9, 9, 9}, 3)}});
  testing::internal::CaptureStdout();
  EXPECT_EQ(read().grid->maximum(), 2);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_P(BadVolumeTest, TruncatedFilesSayHowTheyEnd) {
  write({{.voxels = test::filled_box({0, 0, 0}, {40, 40, 40}, 1)},
         {.name = "temperature", .voxels = test::filled_box({0, 0, 0}, {9, 9, 9}, 1)}});
  const std::string bytes = test::read_bytes(path());
  for (int percent = 0; percent < 100; percent += 3) {
    std::ofstream(path(), std::ios::binary)
        << bytes.substr(0, bytes.size() * static_cast<size_t>(percent) / 100);
    const std::string text = complaint();
    const bool is_known = text == "it is neither an OpenVDB nor a NanoVDB file" ||
                          text == "the file ends within its directory" ||
                          text.starts_with("it is truncated: grid \"");
    EXPECT_TRUE(is_known) << percent << " %: " << text;
  }
}

TEST_P(BadVolumeTest, DamagedBytesNeverCrash) {
  write({{.voxels = test::filled_box({0, 0, 0}, {20, 20, 20}, 1)}});
  const std::string bytes = test::read_bytes(path());
  RandomStream rng(3);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = bytes;
    // Behind the header; a changed name or transform is no damage that could be seen.
    const size_t at = 300 + rng.next_bits() % (bytes.size() - 300);
    damaged[at] =
        static_cast<char>(damaged[at] ^ static_cast<char>(1 + rng.next_bits() % 255));
    std::ofstream(path(), std::ios::binary) << damaged;
    const std::string text = complaint();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    message_of([&] { list_volume_grids(path()); });
  }
}

// What OpenVDB would not survive: four bytes of ones, or of others, from place to place.
TEST(BadVdbTest, DamageIsAnErrorThatNamesTheGrid) {
  if (!test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  const TemporaryFolder folder;
  const std::string path = folder.file("v.vdb");
  test::write_vdb(path, {{.voxels = test::filled_box({0, 0, 0}, {40, 40, 40}, 1)}});
  const std::string bytes = test::read_bytes(path);
  int damaged_count = 0;
  for (size_t at = 60; at + 4 < bytes.size(); at += 61) {
    std::string damaged = bytes;
    damaged.replace(at, 4, at % 2 ? "\xff\xff\xff\xff" : "\x03\x80\x11\x7f");
    std::ofstream(path, std::ios::binary) << damaged;
    const std::string text = message_of([&] { list_volume_grids(path); });
    damaged_count += text == path + ": grid \"density\" is damaged";
  }
  EXPECT_GT(damaged_count, 100);
}

// Twelve bytes of metadata that say they are 4 GB, a map of no known kind, and a tree type.
TEST(BadVdbTest, HeadersAreCheckedBeforeTheyAreBelieved) {
  if (!test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  const TemporaryFolder folder;
  const std::string path = folder.file("v.vdb");
  test::write_vdb(path, {{.voxels = test::filled_box({0, 0, 0}, {9, 9, 9}, 1)}});
  const std::string bytes = test::read_bytes(path);
  const auto complaint = [&](const std::string& word, size_t behind, const char* with) {
    std::string damaged = bytes;
    damaged.replace(damaged.find(word) + behind, 4, with);
    std::ofstream(path, std::ios::binary) << damaged;
    const std::string text = message_of([&] { read_volume(path, density); });
    return text.substr(std::min(text.size(), path.size() + 2));
  };
  const std::string damaged_grid = "grid \"density\" is damaged";
  EXPECT_EQ(complaint("file_bbox_max", 13 + 4 + 5, "\xff\xff\xff\xff"), damaged_grid);
  EXPECT_EQ(complaint("ScaleTranslateMap", 0, "\x1b[7m"), damaged_grid);
  EXPECT_EQ(complaint("Tree_float_5_4_3", 4, "\x1b[7m"), "its directory is damaged");
  EXPECT_EQ(complaint("Tree_float_5_4_3", 16, "\xff\xff\xff\x7f"),
            "its directory is damaged");
}

// Files are read in pieces along x.
TEST_P(BadVolumeTest, GridsOfAnyLengthAreReadInFull) {
  for (const int blocks : {1, 15, 16, 17, 37, 50, 97, 200}) {
    std::vector<test::TestVoxel> voxels;
    for (int i = 0; i < blocks; ++i)
      voxels.push_back({{8 * i, 0, 0}, static_cast<float>(i + 1)});
    write({{.voxels = voxels}});
    const PlacedGrid grid = read();
    for (const test::TestVoxel& v : voxels) {
      const Vec3 p = grid.medium_from_grid.inverse().point({static_cast<float>(v.at.x),
                                                            static_cast<float>(v.at.y),
                                                            static_cast<float>(v.at.z)});
      const float step = (v.value + 1) / 131'000;  // a little over half of the scale's
      ASSERT_NEAR(grid.grid->interpolate(p), v.value, step) << blocks << " blocks";
      // In the brick before this one.
      ASSERT_NEAR(grid.grid->interpolate(p - Vec3{0.25f, 0, 0}), 0.75f * v.value, step)
          << blocks << " blocks";
    }
  }
}

TEST_P(BadVolumeTest, MissingNamesAreAnsweredWithThoseFound) {
  write({{.name = "smoke", .voxels = test::filled_box({0, 0, 0}, {2, 2, 2}, 1)},
         {.name = "heat", .voxels = test::filled_box({0, 0, 0}, {2, 2, 2}, 1)}});
  const std::string text = complaint();
  const std::string start = "there is no grid \"density\"; the file has ";
  const bool is_known = text == start + "\"smoke\" (float), \"heat\" (float)" ||
                        text == start + "\"heat\" (float), \"smoke\" (float)";
  EXPECT_TRUE(is_known) << text;
}

// A cube of optical depth one, from the size of a grain of dust to that of a star.
TEST_P(BadVolumeTest, AbsurdExtentsAreNoTrouble) {
  // OpenVDB has no voxels below 1.4e-5.
  const bool is_vdb = GetParam().name == std::string("v.vdb");
  for (const double size : {is_vdb ? 2e-5 : 1e-7, 1e-3, 1.0, 1e7, 1e8}) {
    write({{.voxels = test::filled_box({0, 0, 0}, {9, 9, 9}, 1), .voxel_size = size}});
    const float s = static_cast<float>(size);
    const GridMedium medium = medium_of(read(), 1 / (10 * s));
    const Ray ray{{-30 * s, 4.5f * s, 4.5f * s}, {1, 0, 0}};
    EXPECT_NEAR(transmittance(medium, ray), std::exp(-1.0), 0.04) << size;
  }
}

// 2155^3 voxels between two active ones: a table of bricks, and hardly anything else.
TEST_P(BadVolumeTest, HugeSparseBoxesFit) {
  write({{.voxels = {{{-1077, -1077, -1077}, 2}, {{1077, 1077, 1077}, 2}}}});
  const PlacedGrid grid = read();
  EXPECT_LT(grid.grid->memory(), 200u << 20);
  const Ray ray{{-1077 - 3, -1077, -1077}, {1, 0, 0}};
  EXPECT_NEAR(transmittance(medium_of(grid), ray), std::exp(-2.0), 0.03);
}

TEST_P(BadVolumeTest, AbsurdBoxesAreRefused) {
  write({{.voxels = {{{-1000000, 0, 0}, 2}, {{1000000, 1000000, 0}, 2}}}});
  EXPECT_EQ(complaint(),
            "the active voxels span 2000001 x 1000001 x 1, more than fits in memory");
}

TEST_P(BadVolumeTest, VoxelsWithoutNeighborsAreRefused) {
  write({{.voxels = test::filled_box({INT32_MIN, 0, 0}, {INT32_MIN + 7, 7, 7}, 2)}});
  EXPECT_EQ(complaint(),
            "the active voxels begin at (-2147483648, 0, 0), too far from the origin");
}

}  // namespace
}  // namespace tyndall
