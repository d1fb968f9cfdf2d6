// SPDX-License-Identifier: Apache-2.0
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/SignedFloodFill.h>

#include "support/volume_writer.h"

namespace tyndall::test {
namespace {

openvdb::FloatGrid::Ptr make_grid(const TestGrid& test) {
  auto grid = openvdb::FloatGrid::create(test.half_width);
  grid->setName(test.name);
  const bool is_level_set = test.half_width > 0;
  grid->setGridClass(is_level_set ? openvdb::GRID_LEVEL_SET : openvdb::GRID_FOG_VOLUME);
  const auto map = openvdb::math::Transform::createLinearTransform(test.voxel_size);
  map->postTranslate({test.origin.x, test.origin.y, test.origin.z});
  grid->setTransform(map);
  auto accessor = grid->getAccessor();
  for (const TestVoxel& v : test.voxels)
    accessor.setValue({v.at.x, v.at.y, v.at.z}, v.value);
  if (is_level_set) openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

void write(const std::filesystem::path& path, const openvdb::GridPtrVec& grids) {
  openvdb::io::File file(path.string());
  file.write(grids);
  file.close();
}

}  // namespace

const bool has_openvdb = true;

void write_vdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids) {
  openvdb::initialize();
  openvdb::GridPtrVec made;
  for (const TestGrid& grid : grids) made.push_back(make_grid(grid));
  write(path, made);
}

void write_vdb_without_numbers(const std::filesystem::path& path) {
  openvdb::initialize();
  const auto points = openvdb::points::PointDataGrid::create();
  points->setName("points");
  const auto vectors = openvdb::Vec3SGrid::create();
  vectors->setName("v");
  vectors->getAccessor().setValue({1, 2, 3}, {1, 0, 0});
  write(path, {points, vectors});
}

}  // namespace tyndall::test
