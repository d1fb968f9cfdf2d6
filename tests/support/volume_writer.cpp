// SPDX-License-Identifier: Apache-2.0
#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include "support/volume_writer.h"

#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

namespace tyndall::test {
namespace {

nanovdb::GridHandle<nanovdb::HostBuffer> make_grid(const TestGrid& test) {
  nanovdb::GridBuilder<float> builder(0.0f, nanovdb::GridClass::FogVolume);
  auto accessor = builder.getAccessor();
  for (const TestVoxel& v : test.voxels)
    accessor.setValue(nanovdb::Coord(v.at.x, v.at.y, v.at.z), v.value);
  return builder.getHandle<>(test.voxel_size,
                             nanovdb::Vec3d(test.origin.x, test.origin.y, test.origin.z),
                             test.name);
}

}  // namespace

std::vector<TestVoxel> filled_box(Vec3i first, Vec3i last, float value) {
  std::vector<TestVoxel> voxels;
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) voxels.push_back({{x, y, z}, value});
  return voxels;
}

void write_nvdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids,
                NvdbCodec codec) {
  std::vector<nanovdb::GridHandle<nanovdb::HostBuffer>> handles;
  for (const TestGrid& grid : grids) handles.push_back(make_grid(grid));
  nanovdb::io::writeGrids<nanovdb::HostBuffer, std::vector>(
      path.string(), handles, static_cast<nanovdb::io::Codec>(codec));
}

}  // namespace tyndall::test
