// SPDX-License-Identifier: Apache-2.0
#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include "support/volume_writer.h"

#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace tyndall::test {
namespace {

nanovdb::GridHandle<nanovdb::HostBuffer> make_grid(const TestGrid& test) {
  const bool is_level_set = test.half_width > 0;
  nanovdb::GridBuilder<float> builder(test.half_width, is_level_set
                                                           ? nanovdb::GridClass::LevelSet
                                                           : nanovdb::GridClass::FogVolume);
  auto accessor = builder.getAccessor();
  for (const TestVoxel& v : test.voxels)
    accessor.setValue(nanovdb::Coord(v.at.x, v.at.y, v.at.z), v.value);
  if (is_level_set) builder.sdfToLevelSet();  // which says what is inside
  return builder.getHandle<>(test.voxel_size,
                             nanovdb::Vec3d(test.origin.x, test.origin.y, test.origin.z),
                             test.name);
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<TestVoxel> filled_box(Vec3i first, Vec3i last, float value) {
  std::vector<TestVoxel> voxels;
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) voxels.push_back({{x, y, z}, value});
  return voxels;
}

TestGrid level_set_of_ball(float radius, float half_width) {
  const int reach = static_cast<int>(radius + half_width) + 1;
  std::vector<TestVoxel> band;
  for (TestVoxel v : filled_box({-reach, -reach, -reach}, {reach, reach, reach}, 0)) {
    v.value = length(Vec3{static_cast<float>(v.at.x), static_cast<float>(v.at.y),
                          static_cast<float>(v.at.z)}) -
              radius;
    if (std::abs(v.value) < half_width) band.push_back(v);
  }
  return {.voxels = band, .half_width = half_width};
}

void write_nvdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids,
                NvdbCodec codec) {
  std::vector<nanovdb::GridHandle<nanovdb::HostBuffer>> handles;
  for (const TestGrid& grid : grids) handles.push_back(make_grid(grid));
  nanovdb::io::writeGrids<nanovdb::HostBuffer, std::vector>(
      path.string(), handles, static_cast<nanovdb::io::Codec>(codec));
}

}  // namespace tyndall::test
