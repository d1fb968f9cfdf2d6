// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/volume_info.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image/temporary_folder.h"

namespace tyndall::app {
namespace {

VolumeGridInfo far_apart() {
  constexpr int far = 2'000'000'000;
  return {.name = "smoke",
          .type = "float",
          .is_scalar = true,
          .first = {-far, -far, INT32_MIN},
          .last = {far, far, INT32_MAX},
          .bounds = {{-1, -2, -3}, {1, 2, 3}},
          .voxel_size = {1, 1, 1},
          .active_voxels = 2,
          .memory = 640,
          .min = 1,
          .max = 2,
          .compression = "zip"};
}

// A file of four bytes: only its size is looked at.
std::string file_in(const TemporaryFolder& folder) {
  std::ofstream(folder.file("v.vdb")) << "VDB!";
  return folder.file("v.vdb");
}

TEST(VolumeInfo, CountsVoxelsThatAreFarApart) {
  const TemporaryFolder folder;
  const std::string path = file_in(folder);
  EXPECT_EQ(volume_text(path, {far_apart()}),
            path +
                ": 4 B in the file, 1 grid\n"
                "  \"smoke\": float\n"
                "    voxels    2 active in 4000000001 x 4000000001 x 4294967296\n"
                "    voxel     1 x 1 x 1\n"
                "    bounds    (-1, -2, -3) to (1, 2, 3)\n"
                "    values    1 to 2\n"
                "    memory    640 B, compression zip\n");
  const nlohmann::ordered_json json = volume_json(path, {far_apart()});
  EXPECT_EQ(json["grids"][0]["voxels"].dump(), "[4000000001,4000000001,4294967296]");
}

TEST(VolumeInfo, ShowsNoControlCharacters) {
  const TemporaryFolder folder;
  VolumeGridInfo grid = far_apart();
  grid.name = "dichte_\xc3\xa4\n\x1b[31m\xff";
  EXPECT_NE(
      volume_text(file_in(folder), {grid}).find("\n  \"dichte_\xc3\xa4??[31m?\": float"),
      std::string::npos);
}

}  // namespace
}  // namespace tyndall::app
