// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/volume_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/volume_writer.h"
#include "tyndall/media/volume_bricks.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

const fs::path shared = fs::path(TYNDALL_SOURCE_DIR) / "../shared/scenes";
constexpr std::string_view density_name[] = {"density"};

/// A file of this test's own, removed at its end.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& bytes)
      : path_(fs::temp_directory_path() /
              ("tyndall_volume_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name() +
               std::to_string(count_++))) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { fs::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  inline static int count_ = 0;
  fs::path path_;
};

/// What read_volume() says of bytes that it cannot read, without the file's name.
std::string complaint(const std::string& bytes) {
  const TemporaryFile file(bytes);
  try {
    read_volume(file.path(), density_name);
  } catch (const std::runtime_error& e) {
    const std::string text = e.what(), name = file.path().string() + ": ";
    EXPECT_EQ(text.substr(0, name.size()), name);
    return text.substr(std::min(name.size(), text.size()));
  }
  return "it was read";
}

float value_at(const PlacedGrid& grid, Vec3 p_medium) {
  const Vec3 p = grid.medium_from_grid.inverse().point(p_medium);
  return grid.box.contains(p) ? grid.grid->interpolate(p) : 0;
}

// Leaves that take many of Blosc's blocks: noise and zeros, whole and cut off blocks.
TEST(VolumeFileTest, PackedGridsHoldTheSameVoxels) {
  const TemporaryFile none(""), zip(""), blosc("");
  RandomStream rng(3);
  std::vector<test::TestVoxel> voxels = test::filled_box({0, 0, 0}, {80, 70, 60}, 0);
  for (test::TestVoxel& v : voxels) v.value = v.at.x < 30 ? 1 : rng.next_1d();
  test::write_nvdb(none.path(), {{.voxels = voxels}}, test::NvdbCodec::none);
  test::write_nvdb(zip.path(), {{.voxels = voxels}}, test::NvdbCodec::zip);
  test::write_nvdb(blosc.path(), {{.voxels = voxels}}, test::NvdbCodec::blosc);
  const PlacedGrid a = read_volume(none.path(), density_name);
  for (const fs::path& path : {zip.path(), blosc.path()}) {
    const PlacedGrid b = read_volume(path, density_name);
    ASSERT_EQ(a.grid->brick_count(), b.grid->brick_count());
    for (const test::TestVoxel& v : voxels) {
      const Vec3 p{static_cast<float>(v.at.x), static_cast<float>(v.at.y),
                   static_cast<float>(v.at.z)};
      ASSERT_EQ(value_at(a, p), value_at(b, p)) << path << " " << v.at.x;
    }
    EXPECT_NEAR(value_at(b, {75, 40, 33}), voxels[(33 * 71 + 40) * 81 + 75].value, 1e-4f);
  }
}

class SharedVolumes : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(shared / "data/vdb")) GTEST_SKIP() << "no ../shared";
  }
};

TEST_F(SharedVolumes, AllCanBeListedAndTheirNumbersRead) {
  int grids = 0;
  for (const fs::directory_entry& file : fs::directory_iterator(shared / "data/vdb")) {
    const bool is_vdb = file.path().extension() == ".vdb" && test::has_openvdb;
    if (!is_vdb && file.path().extension() != ".nvdb") continue;
    SCOPED_TRACE(file.path().string());
    for (const VolumeGridInfo& info : list_volume_grids(file.path())) {
      EXPECT_GT(info.memory, 0);
      EXPECT_GT(info.voxel_size.x, 0);
      if (!info.is_scalar) continue;
      const std::string_view names[] = {info.name};
      const PlacedGrid read = read_volume(file.path(), names);
      EXPECT_EQ(read.grid->rejected().not_finite, 0);
      if (read.grid->is_empty()) continue;
      // The samples of positive value are active voxels.
      const Vec3 low =
          read.medium_from_grid.point({static_cast<float>(read.grid->first().x),
                                       static_cast<float>(read.grid->first().y),
                                       static_cast<float>(read.grid->first().z)});
      Bounds3 around = info.bounds;
      around.extend(info.bounds.min - info.voxel_size);
      around.extend(info.bounds.max + info.voxel_size);
      EXPECT_TRUE(around.contains(low));
      if (std::isfinite(info.max)) {
        EXPECT_FLOAT_EQ(read.grid->maximum(), std::max(info.max, 0.0f));
      }
      ++grids;
    }
  }
  EXPECT_GT(grids, test::has_openvdb ? 8 : 1);
}

// The same smoke in both formats.
TEST_F(SharedVolumes, OpenVdbAndNanoVdbAgree) {
  if (!test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  const fs::path folder = shared / "wild/smoke1-openvdb/geometry";
  const PlacedGrid a = read_volume(folder / "smoke1.vdb", density_name);
  const PlacedGrid b = read_volume(folder / "smoke1.nvdb", density_name);
  EXPECT_EQ(a.grid->maximum(), b.grid->maximum());
  EXPECT_EQ(a.grid->brick_count(), b.grid->brick_count());
  RandomStream rng(1);
  int positive = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p_grid =
        a.box.min + a.box.diagonal() * Vec3{rng.next_1d(), rng.next_1d(), rng.next_1d()};
    const Vec3 p = a.medium_from_grid.point(p_grid);
    EXPECT_NEAR(value_at(a, p), value_at(b, p), 1e-4f * a.grid->maximum());
    positive += value_at(a, p) > 0 ? 1 : 0;
  }
  EXPECT_GT(positive, 1000);
}

TEST_F(SharedVolumes, MissingNamesAreAnsweredWithThoseFound) {
  if (!test::has_openvdb) GTEST_SKIP() << "no OpenVDB";
  const fs::path path = shared / "data/vdb/usd_densityAndHeat.vdb";
  constexpr std::string_view names[] = {"smoke"};
  try {
    read_volume(path, names);
    FAIL() << "a grid was found";
  } catch (const std::runtime_error& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find(": there is no grid \"smoke\"; the file has \""), std::string::npos)
        << text;
    EXPECT_NE(text.find("\"density\" (float)"), std::string::npos) << text;
  }
}

TEST_F(SharedVolumes, TheOnlyGridNeedsNoName) {
  const PlacedGrid read =
      read_volume(shared / "data/vdb/fvdb_smoke-blosc.nvdb", density_name);
  EXPECT_FALSE(read.grid->is_empty());
}

// Every prefix of a file is an error or an empty or shorter grid, never a crash.
TEST_F(SharedVolumes, TruncatedFilesAreErrors) {
  for (const char* name :
       {"data/vdb/oiio_sphere.vdb", "data/vdb/shadeops_teapot_cloud.nvdb",
        "data/vdb/fvdb_smoke-blosc.nvdb"}) {
    const std::string bytes = test::read_bytes(shared / name);
    for (const double share : {0.0, 1e-5, 1e-4, 1e-3, 0.1, 0.5, 0.9, 0.999})
      EXPECT_NE(
          complaint(bytes.substr(0, static_cast<size_t>(share * double(bytes.size())))),
          "it was read")
          << name << " " << share;
  }
}

TEST_F(SharedVolumes, DamagedNanoVdbFilesAreErrors) {
  const std::string bytes =
      test::read_bytes(shared / "data/vdb/shadeops_teapot_cloud.nvdb");
  const auto damage = [&](size_t at, char value) {
    std::string copy = bytes;
    for (size_t i = 0; i < 7; ++i) copy[at + i] = value;
    return complaint(copy);
  };
  EXPECT_EQ(damage(16, 0x7f), "its directory is damaged");         // size in memory
  EXPECT_EQ(damage(bytes.size() / 2, 0x55), "a grid is damaged");  // within the packed grid
}

TEST(VolumeFileTest, ExplainsWhatItCannotRead) {
  EXPECT_EQ(complaint("hello, this is text"),
            "it is neither an OpenVDB nor a NanoVDB file");
  EXPECT_EQ(complaint(""), "it is neither an OpenVDB nor a NanoVDB file");
  EXPECT_EQ(complaint("NanoVDB0"), "the file ends within its directory");
  EXPECT_EQ(
      complaint(std::string("NanoVDB0\x13\0\0\0\1\0\0\0", 16)),
      "it was written by NanoVDB before 32, only 32.x can be read; convert it anew with "
      "nanovdb_convert");
  EXPECT_THROW(
      try {
        read_volume("/nonexistent/x.vdb", density_name);
      } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "/nonexistent/x.vdb: No such file or directory");
        throw;
      },
      std::runtime_error);
}

// Two voxels, ten thousand million voxels apart: a table of bricks, and nothing else.
TEST(VolumeBricksTest, HugeSparseBoxesFit) {
  const BrickLayout layout = lay_out_bricks({-1077, -1077, -1077}, {1077, 1077, 1077});
  const auto source = [&](Vec3i brick, BrickGrid::Samples samples) {
    const bool is_first = brick == Vec3i{0, 0, 0};
    const bool is_last = brick == Vec3i{layout.brick_count.x - 1, layout.brick_count.y - 1,
                                        layout.brick_count.z - 1};
    if (!is_first && !is_last) return false;
    std::fill(samples.begin(), samples.end(), 0.0f);
    samples[is_first ? 364 : 0] = 2;
    return true;
  };
  Matrix4 m{};
  for (size_t i = 0; i < 4; ++i) m[i][i] = 1;
  const PlacedGrid placed = place_bricks(layout, m, source);
  EXPECT_EQ(placed.grid->maximum(), 2);
  const size_t bricks = size_t{271} * 271 * 271;
  EXPECT_LT(placed.grid->memory(), 8 * bricks + 10'000);
}

TEST(VolumeBricksTest, RefusesAbsurdBoxes) {
  try {
    lay_out_bricks({INT32_MIN, 0, INT32_MIN}, {INT32_MAX, 0, INT32_MAX});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(),
                 "the active voxels span 4294967296 x 1 x 4294967296, more than fits in "
                 "memory");
  }
}

// Blocks of constants, one brick in the middle of them: aprons come from the neighbours.
TEST(VolumeBricksTest, BricksTakeTheirApronFromTheirNeighbours) {
  const BrickLayout layout = lay_out_bricks({0, 0, 0}, {15, 7, 7});
  EXPECT_EQ(layout.origin, (Vec3i{-8, -8, -8}));
  struct Constant {
    float v;
    bool is_zero() const { return v == 0; }
    float value(int /*i*/) const { return v; }
  };
  std::array<float, BrickGrid::brick_size> samples;
  const auto block_at = [](Vec3i voxel) {
    if (voxel.y != 0 || voxel.z != 0) return Constant{0};
    return Constant{voxel.x == 0 ? 3.0f : voxel.x == 8 ? 5.0f : 0.0f};
  };
  EXPECT_TRUE(fill_brick(layout, {1, 1, 1}, samples, block_at));
  EXPECT_EQ(samples[0], 3);
  EXPECT_EQ(samples[7], 3);
  EXPECT_EQ(samples[8], 5);
  EXPECT_EQ(samples[8 * 9], 0);   // y = 8
  EXPECT_EQ(samples[8 * 81], 0);  // z = 8
  EXPECT_EQ(samples[7 * 81 + 7 * 9 + 7], 3);
  EXPECT_FALSE(fill_brick(layout, {1, 2, 1}, samples, block_at));
}

}  // namespace
}  // namespace tyndall
