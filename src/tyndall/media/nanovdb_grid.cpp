// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "tyndall/media/nanovdb_file.h"
#include "tyndall/media/nanovdb_stream.h"
#include "tyndall/media/sparse_memory.h"
#include "tyndall/media/volume_bricks.h"

namespace tyndall {
namespace {

// Whether all nodes that a damaged tree points to lie within its `size` bytes.
template <typename Build>
class TreeCheck {
  using Tree = typename nanovdb::NanoGrid<Build>::TreeType;
  using Root = typename Tree::RootType;
  using Leaf = typename Tree::LeafNodeType;
  using Upper = typename Root::ChildNodeType;

 public:
  TreeCheck(const std::byte* begin, size_t size) : begin_(begin), size_(size) {}

  bool is_sound(const nanovdb::NanoGrid<Build>& grid) const {
    const auto* tree = grid.tree().data();
    const Root* root = behind<Root>(tree, tree->mNodeOffset[3]);
    if (!root) return false;
    const uint32_t tiles = root->data()->mTableSize;
    if (tiles > size_ / 8 || !holds(root, Root::memUsage(tiles))) return false;
    for (uint32_t i = 0; i < tiles; ++i) {
      const auto* tile = root->data()->tile(i);
      if (tile->isChild() && !is_sound(behind<Upper>(root, tile->child))) return false;
    }
    return true;
  }

 private:
  bool holds(const void* node, uint64_t size) const {
    const uintptr_t at = reinterpret_cast<uintptr_t>(node),
                    begin = reinterpret_cast<uintptr_t>(begin_);
    return at >= begin && at - begin <= size_ && size <= size_ - (at - begin) &&
           (at - begin) % NANOVDB_DATA_ALIGNMENT == 0;
  }

  // The node that lies `offset` bytes behind another, before it if negative; null if the
  // image does not hold it. There are no pointers to outside: even to make one is
  // undefined.
  template <typename Node, typename Offset>
  const Node* behind(const void* from, Offset offset) const {
    const uintptr_t at = reinterpret_cast<uintptr_t>(from) -
                         reinterpret_cast<uintptr_t>(begin_) +
                         static_cast<uintptr_t>(offset);
    if (at > size_ || sizeof(Node) > size_ - at || at % NANOVDB_DATA_ALIGNMENT != 0)
      return nullptr;
    return reinterpret_cast<const Node*>(begin_ + at);
  }

  template <typename Node>
  bool is_sound(const Node* node) const {
    if (!node) return false;
    if constexpr (std::is_same_v<Node, Leaf>) {
      return holds(node, node->data()->memUsage());
    } else {
      using Child = typename Node::ChildNodeType;
      for (auto i = node->data()->mChildMask.beginOn(); i; ++i)
        if (!is_sound(behind<Child>(node, node->data()->mTable[*i].child))) return false;
      return true;
    }
  }

  const std::byte* begin_;
  size_t size_;
};

// The memory image of a grid. Its directory is held; of its leaves, only those that the
// bricks in hand touch.
class GridImage {
 public:
  GridImage(std::ifstream& file, const NanoVdbEntry& entry)
      : file_(file), entry_(entry), memory_(size_of(entry)) {
    NanoVdbStream stream(file, entry);
    stream.read({memory_.data(), header_size});
    if (header().mMagic != NANOVDB_MAGIC_NUMBER || header().mGridSize > memory_.size() ||
        static_cast<uint32_t>(header().mGridType) != entry.type)
      throw std::runtime_error("a grid is damaged");
  }

  const nanovdb::GridData& header() {
    return *reinterpret_cast<const nanovdb::GridData*>(memory_.data());
  }

  template <typename Build>
  const nanovdb::NanoGrid<Build>& grid() {
    return *reinterpret_cast<const nanovdb::NanoGrid<Build>*>(memory_.data());
  }

  // Reads all but the leaves, or all if leaves do not lie in a row.
  template <typename Build>
  void read_directory() {
    using Leaf = typename nanovdb::NanoGrid<Build>::TreeType::LeafNodeType;
    const auto& header = grid<Build>();
    directory_size_ = memory_.size();
    if (header.template isSequential<Leaf>() && header.tree().nodeCount(0) > 0) {
      leaf_count_ = header.tree().nodeCount(0);
      const auto* tree = reinterpret_cast<const std::byte*>(&header.tree());
      directory_size_ =
          static_cast<size_t>(tree - memory_.data()) + header.tree().data()->mNodeOffset[0];
      if (directory_size_ < header_size || directory_size_ > memory_.size() ||
          (memory_.size() - directory_size_) / sizeof(Leaf) < leaf_count_)
        throw std::runtime_error("a grid is damaged");
    }
    NanoVdbStream(file_, entry_).read({memory_.data(), directory_size_});
    if (!TreeCheck<Build>(memory_.data(), memory_.size()).is_sound(grid<Build>()))
      throw std::runtime_error("a grid is damaged");
  }

  // Reads the leaves of voxels [first, last] along x in place of all others.
  template <typename Build>
  void read_leaves(int first, int last) {
    using Leaf = typename nanovdb::NanoGrid<Build>::TreeType::LeafNodeType;
    if (leaf_count_ == 0) return;
    std::byte* begin = memory_.data() + directory_size_;
    memory_.release(directory_size_, memory_.size());
    NanoVdbStream stream(file_, entry_);
    stream.skip(directory_size_);
    alignas(NANOVDB_DATA_ALIGNMENT) std::array<std::byte, sizeof(Leaf)> bytes;
    for (uint32_t i = 0; i < leaf_count_; ++i) {
      stream.read(bytes);
      const auto& leaf = *reinterpret_cast<const Leaf*>(bytes.data());
      const int x = leaf.origin()[0];
      if (x + 7 >= first && x <= last)
        std::memcpy(begin + size_t{i} * sizeof(Leaf), bytes.data(), bytes.size());
    }
    stream.skip(memory_.size() - directory_size_ - leaf_count_ * sizeof(Leaf));
    stream.check_end();
  }

 private:
  static constexpr size_t header_size =
      sizeof(nanovdb::GridData) + sizeof(nanovdb::TreeData<3>);

  static size_t size_of(const NanoVdbEntry& entry) {
    // No codec packs better than this; a larger size is damage, not data.
    constexpr uint64_t best_ratio = 4096;
    if (entry.info.memory < header_size ||
        entry.info.memory / best_ratio > entry.packed_size)
      throw std::runtime_error("its directory is damaged");
    return entry.info.memory;
  }

  std::ifstream& file_;
  const NanoVdbEntry& entry_;
  SparseMemory memory_;
  size_t directory_size_ = 0;
  uint32_t leaf_count_ = 0;  // 0: they were read with the directory
};

// 8^3 voxels: a leaf, or a tile of one value.
template <typename Build>
struct Block {
  const typename nanovdb::NanoGrid<Build>::TreeType::LeafNodeType* leaf;
  float tile;
  DensityCode density;

  bool is_zero() const { return !leaf && tile == 0; }
  float value(int i) const {
    if (!leaf) return tile;
    const uint32_t n = static_cast<uint32_t>(i);
    return density(static_cast<float>(leaf->getValue(n)), leaf->isActive(n));
  }
};

// Reads the leaves for the bricks that are asked for, a sixth of all at a time: each time
// the whole grid is unpacked anew.
template <typename Build>
BrickGrid::Prepare leaf_reader(GridImage& image, const BrickLayout& layout) {
  return [&image, layout, ready = 0](int first, int last) mutable {
    if (last <= ready) return;
    constexpr int parts = 6;
    ready = std::max(last, first + (layout.brick_count.x + parts - 1) / parts);
    const auto voxel = [&](int brick) { return layout.origin.x + brick * BrickGrid::edge; };
    image.template read_leaves<Build>(voxel(first), voxel(ready));
  };
}

Matrix4 medium_from_voxel(const nanovdb::Map& map) {
  Matrix4 m{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) m[i][j] = map.mMatD[3 * i + j];
    m[i][3] = map.mVecD[i];
  }
  m[3][3] = 1;
  return m;
}

template <typename Build>
PlacedGrid convert(GridImage& image) {
  image.read_directory<Build>();
  const auto& grid = image.grid<Build>();
  const auto& box = grid.indexBBox();
  if (box.min()[0] > box.max()[0]) return empty_grid();
  const BrickLayout layout = lay_out_bricks({box.min()[0], box.min()[1], box.min()[2]},
                                            {box.max()[0], box.max()[1], box.max()[2]});
  const auto& root = grid.tree().root();
  const auto density = grid.isLevelSet()
                           ? DensityCode::level_set(static_cast<float>(root.background()))
                           : DensityCode();
  const auto source = [&](Vec3i brick, BrickGrid::Samples samples) {
    return fill_brick(layout, brick, samples, [&](Vec3i voxel) {
      const nanovdb::Coord at(voxel.x, voxel.y, voxel.z);
      const auto* leaf = root.probeLeaf(at);
      const float tile =
          leaf ? 0 : density(static_cast<float>(root.getValue(at)), root.isActive(at));
      return Block<Build>{leaf, tile, density};
    });
  };
  PlacedGrid placed = place_bricks(layout, medium_from_voxel(grid.map()), source,
                                   leaf_reader<Build>(image, layout));
  placed.is_from_level_set = grid.isLevelSet();
  return placed;
}

template <typename Build>
void add_range(GridImage& image, VolumeGridInfo& info) {
  image.read_directory<Build>();
  const auto& grid = image.grid<Build>();
  if (!grid.hasMinMax() || info.active_voxels == 0) return;
  const auto least = static_cast<float>(grid.tree().root().minimum());
  const auto largest = static_cast<float>(grid.tree().root().maximum());
  if (!(least <= largest)) return;  // no voxel holds a number
  info.min = least;
  info.max = largest;
}

// The box of the active voxels. What the directory says of it is half a voxel off: it takes
// a voxel for the cube above its position, not for that about it.
Bounds3 bounds_of(const nanovdb::Map& map, Vec3i first, Vec3i last) {
  Bounds3 bounds;
  for (int corner = 0; corner < 8; ++corner) {
    const auto along = [&](int axis, int a, int b) {
      return corner >> axis & 1 ? double{b} + 0.5 : double{a} - 0.5;
    };
    const nanovdb::Vec3d p = map.applyMap(nanovdb::Vec3d(
        along(0, first.x, last.x), along(1, first.y, last.y), along(2, first.z, last.z)));
    bounds.extend(
        Vec3{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  return bounds;
}

// Calls f with a value of the grid's number type.
template <typename F>
auto with_type(const NanoVdbEntry& entry, F&& f) {
  switch (static_cast<nanovdb::GridType>(entry.type)) {
    case nanovdb::GridType::Float:
      return f(float{});
    case nanovdb::GridType::Double:
      return f(double{});
    case nanovdb::GridType::Fp4:
      return f(nanovdb::Fp4{});
    case nanovdb::GridType::Fp8:
      return f(nanovdb::Fp8{});
    case nanovdb::GridType::Fp16:
      return f(nanovdb::Fp16{});
    case nanovdb::GridType::FpN:
      return f(nanovdb::FpN{});
    default:
      throw std::runtime_error(
          fmt::format("grids of type {} hold no density", entry.info.type));
  }
}

}  // namespace

void read_nanovdb_details(std::ifstream& file, const NanoVdbEntry& entry,
                          VolumeGridInfo& info) {
  GridImage image(file, entry);
  if (info.first.x <= info.last.x)
    info.bounds = bounds_of(image.header().mMap, info.first, info.last);
  if (!info.is_scalar) return;
  with_type(entry, [&](auto type) { add_range<decltype(type)>(image, info); });
}

PlacedGrid read_nanovdb_grid(std::ifstream& file, const NanoVdbEntry& entry) {
  GridImage image(file, entry);
  return with_type(entry, [&](auto type) { return convert<decltype(type)>(image); });
}

}  // namespace tyndall
