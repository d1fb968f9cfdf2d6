// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tyndall/math/vec.h"

namespace tyndall::test {

/// One active voxel.
struct TestVoxel {
  Vec3i at;
  float value;
};

/// A grid of a volume file; voxel (0, 0, 0) sits at `origin`.
struct TestGrid {
  std::string name = "density";
  std::vector<TestVoxel> voxels;
  double voxel_size = 1;
  Vec3 origin{};
  /// Of a level set, half the width of its band; zero: the numbers are densities.
  float half_width = 0;
};

/// What is in a file.
std::string read_bytes(const std::filesystem::path& path);

/// The voxels [first, last], all of one value.
std::vector<TestVoxel> filled_box(Vec3i first, Vec3i last, float value);

/// The level set of a ball about the origin, with a band of this half width [voxels].
TestGrid level_set_of_ball(float radius, float half_width);

/// Whether the build has OpenVDB. Tests that need .vdb files are skipped if not.
extern const bool has_openvdb;

/// Writes a .vdb file. Precondition: has_openvdb.
void write_vdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids);
/// A .vdb file with a grid of points called "points" and one of vectors called "v".
void write_vdb_without_numbers(const std::filesystem::path& path);

enum class NvdbCodec { none, zip, blosc };
void write_nvdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids,
                NvdbCodec codec = NvdbCodec::none);

}  // namespace tyndall::test
