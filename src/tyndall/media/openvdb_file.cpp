// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/openvdb_file.h"

#include <fmt/format.h>
#include <openvdb/io/DelayedLoadMetadata.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "tyndall/math/parallel_for.h"
#include "tyndall/media/mapped_pages.h"
#include "tyndall/media/volume_bricks.h"

namespace tyndall {
namespace {

// The sizes of packed leaves that files repeat for slow disks are not to be trusted: those
// of a damaged file send the library astray. Without them it looks at the leaves.
bool initialize_without_sizes() {
  openvdb::initialize();
  openvdb::io::DelayedLoadMetadata::unregisterType();
  return true;
}

// Opens a file; the library's own exceptions become std::runtime_error, which say less of
// its insides.
template <typename F>
auto with_file(const std::filesystem::path& path, F&& f) {
  static const bool is_initialized = initialize_without_sizes();
  static_cast<void>(is_initialized);
  try {
    openvdb::io::File file(path.string());
    file.setCopyMaxBytes(0);
    file.open(/*delayLoad=*/true);
    return f(file);
  } catch (const openvdb::Exception& e) {
    throw std::runtime_error(e.what());
  }
}

// The first grid called `name`, by the name that sets it apart from others of its name:
// asked for by a name that is there twice, the library prints to standard output.
std::string unique_name(openvdb::io::File& file, const std::string& name) {
  using openvdb::io::GridDescriptor;
  for (auto it = file.beginName(); it != file.endName(); ++it) {
    const std::string unique = *it;
    if (GridDescriptor::stripSuffix(GridDescriptor::stringAsUniqueName(unique)) == name)
      return unique;
  }
  return name;
}

Vec3i to_vec(const openvdb::Coord& c) { return {c.x(), c.y(), c.z()}; }
Vec3 to_vec(const openvdb::Vec3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

template <typename GridType>
void add_range(const openvdb::GridBase& base, VolumeGridInfo& info) {
  if (!base.isType<GridType>() || base.activeVoxelCount() == 0) return;
  float least = infinity, largest = -infinity;
  for (auto it = static_cast<const GridType&>(base).cbeginValueOn(); it; ++it) {
    const float v = static_cast<float>(*it);
    least = std::min(least, v);
    largest = std::max(largest, v);
  }
  if (!(least <= largest)) return;  // no voxel holds a number
  info.min = least;
  info.max = largest;
}

// What stands in the file's directory.
VolumeGridInfo make_name(const openvdb::GridBase& grid) {
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  const bool is_points = grid.valueType().starts_with("ptdataidx");
  return {
      .name = grid.getName(),
      .type = is_points ? "points" : grid.valueType(),
      .is_scalar = grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>(),
      .first = {0, 0, 0},
      .last = {-1, -1, -1},
      .bounds = {},
      .voxel_size = {},
      .active_voxels = 0,
      .memory = 0,
      .min = unknown,
      .max = unknown,
      .compression = {},
      .is_level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET};
}

VolumeGridInfo make_info(const openvdb::GridBase& grid) {
  VolumeGridInfo info = make_name(grid);
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  info.first = to_vec(box.min());
  info.last = to_vec(box.max());
  info.voxel_size = to_vec(grid.voxelSize());
  info.active_voxels = grid.activeVoxelCount();
  add_range<openvdb::FloatGrid>(grid, info);
  add_range<openvdb::DoubleGrid>(grid, info);
  info.memory = grid.memUsage();  // with the values, which are read when they are looked at
  if (box.empty()) return info;
  const openvdb::BBoxd real(box.min().asVec3d() - 0.5, box.max().asVec3d() + 0.5);
  const openvdb::BBoxd world = grid.transform().indexToWorld(real);
  info.bounds = {to_vec(world.min()), to_vec(world.max())};
  return info;
}

// 8^3 voxels: a leaf, or a tile of one value.
template <typename Leaf>
struct Block {
  const Leaf* leaf;
  float tile;
  DensityCode density;

  bool is_zero() const { return !leaf && tile == 0; }
  float value(int i) const {
    if (!leaf) return tile;
    const openvdb::Index n = static_cast<openvdb::Index>(i);
    return density(static_cast<float>(leaf->getValue(n)), leaf->isValueOn(n));
  }
};

// A leaf that could not be unpacked cannot be destroyed either: the library takes its
// values for where they lie in the file. Only for damaged files, so that their trees stay.
void keep_for_ever(const openvdb::GridBase::Ptr& grid) {
  static std::mutex mutex;
  static auto* const grids = new std::vector<openvdb::GridBase::Ptr>;
  const std::lock_guard lock(mutex);
  grids->push_back(grid);
}

// Calls f, which looks at values of the grid and so unpacks them.
template <typename F>
auto with_values(const openvdb::GridBase::Ptr& grid, F&& f) {
  try {
    return f();
  } catch (const openvdb::Exception&) {
    keep_for_ever(grid);
    throw std::runtime_error(fmt::format("grid \"{}\" is damaged", grid->getName()));
  }
}

Matrix4 medium_from_voxel(const openvdb::GridBase& grid) {
  if (!grid.transform().isLinear())
    throw std::runtime_error(
        fmt::format("grid \"{}\" is shaped like a frustum; only affine grids can be read",
                    grid.getName()));
  // OpenVDB multiplies row vectors from the left.
  const openvdb::Mat4d map = grid.transform().baseMap()->getAffineMap()->getMat4();
  Matrix4 m{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      m[static_cast<size_t>(i)][static_cast<size_t>(j)] = map(j, i);
  return m;
}

template <typename Tree>
void drop_leaves_below(Tree& tree, int x) {
  using Leaf = typename Tree::LeafNodeType;
  std::vector<openvdb::Coord> origins;
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
    if (leaf->origin().x() < x) origins.push_back(leaf->origin());
  for (const openvdb::Coord& origin : origins)
    delete tree.template stealNode<Leaf>(origin, 0, false);
}

// Of the leaves that begin at x in [first, last). Each is looked at by one thread: whoever
// looked after a failure at one that cannot be unpacked would crash.
template <typename Tree>
void unpack_leaves(const Tree& tree, int first, int last) {
  std::vector<const typename Tree::LeafNodeType*> leaves;
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
    if (leaf->origin().x() >= first && leaf->origin().x() < last) leaves.push_back(&*leaf);
  parallel_for(leaves.size(), [&](size_t i) { static_cast<void>(leaves[i]->getValue(0)); });
}

// The grid's values are read out of a map of the file when they are first looked at; leaves
// that lie behind the bricks in hand are dropped, and so is what was read of the map.
template <typename GridType>
PlacedGrid convert(GridType& grid, const std::filesystem::path& path) {
  using Tree = typename GridType::TreeType;
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) return empty_grid();
  const BrickLayout layout = lay_out_bricks(to_vec(box.min()), to_vec(box.max()));
  const Tree& tree = grid.constTree();
  const bool is_level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  const auto density = is_level_set
                           ? DensityCode::level_set(static_cast<float>(grid.background()))
                           : DensityCode();
  const auto source = [&](Vec3i brick, BrickGrid::Samples samples) {
    return fill_brick(layout, brick, samples, [&](Vec3i voxel) {
      const openvdb::Coord at(voxel.x, voxel.y, voxel.z);
      const auto* leaf = tree.probeConstLeaf(at);
      const float tile =
          leaf ? 0 : density(static_cast<float>(tree.getValue(at)), tree.isValueOn(at));
      return Block<typename Tree::LeafNodeType>{leaf, tile, density};
    });
  };
  const auto prepare = [&](int first, int last) {
    const int begin = layout.origin.x + first * BrickGrid::edge;
    drop_leaves_below(grid.tree(), begin);
    // Bricks share the samples at their ends.
    unpack_leaves(tree, begin, layout.origin.x + last * BrickGrid::edge + 1);
    release_mapped_pages(path);
  };
  PlacedGrid placed = place_bricks(layout, medium_from_voxel(grid), source, prepare);
  placed.is_from_level_set = is_level_set;
  return placed;
}

}  // namespace

std::vector<VolumeGridInfo> list_openvdb_grids(const std::filesystem::path& path) {
  return with_file(path, [](openvdb::io::File& file) {
    std::vector<VolumeGridInfo> infos;
    const openvdb::GridPtrVecPtr grids = file.getGrids();
    for (const openvdb::GridBase::Ptr& grid : *grids)
      infos.push_back(with_values(grid, [&] { return make_info(*grid); }));
    return infos;
  });
}

std::vector<VolumeGridInfo> list_openvdb_names(const std::filesystem::path& path) {
  return with_file(path, [](openvdb::io::File& file) {
    std::vector<VolumeGridInfo> infos;
    const openvdb::GridPtrVecPtr grids = file.readAllGridMetadata();
    for (const openvdb::GridBase::Ptr& grid : *grids) infos.push_back(make_name(*grid));
    return infos;
  });
}

PlacedGrid read_openvdb_grid(const std::filesystem::path& path, const std::string& name) {
  return with_file(path, [&](openvdb::io::File& file) {
    const openvdb::GridBase::Ptr grid = file.readGrid(unique_name(file, name));
    if (const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(grid))
      return with_values(grid, [&] { return convert(*floats, path); });
    if (const auto doubles = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid))
      return with_values(grid, [&] { return convert(*doubles, path); });
    throw std::runtime_error(
        fmt::format("grids of type {} hold no density", grid->valueType()));
  });
}

}  // namespace tyndall
