// SPDX-License-Identifier: Apache-2.0
#include <blosc.h>
#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

#include "tyndall/media/nanovdb_file.h"
#include "tyndall/media/volume_bricks.h"

namespace tyndall {
namespace {

constexpr std::align_val_t alignment{NANOVDB_DATA_ALIGNMENT};

struct AlignedDelete {
  void operator()(std::byte* p) const { ::operator delete[](p, alignment); }
};

// The memory image of a grid.
struct GridBytes {
  std::unique_ptr<std::byte[], AlignedDelete> data;
  size_t size;
};

GridBytes allocate(size_t size) {
  return {std::unique_ptr<std::byte[], AlignedDelete>(
              static_cast<std::byte*>(::operator new[](size, alignment))),
          size};
}

void read_bytes(std::ifstream& file, void* to, uint64_t size) {
  if (!file.read(static_cast<char*>(to), static_cast<std::streamsize>(size)))
    throw std::runtime_error("the file ends within a grid");
}

// A packed block: its size, then its bytes. `left` counts down what the directory promised.
std::vector<char> read_block(std::ifstream& file, uint64_t& left) {
  uint64_t size = 0;
  if (left < sizeof size) throw std::runtime_error("a grid is damaged");
  read_bytes(file, &size, sizeof size);
  left -= sizeof size;
  if (size > left) throw std::runtime_error("a grid is damaged");
  std::vector<char> block(size);
  read_bytes(file, block.data(), size);
  left -= size;
  return block;
}

void unpack_zlib(std::ifstream& file, uint64_t left, const GridBytes& to) {
  const std::vector<char> block = read_block(file, left);
  uLongf size = to.size;
  const int status = uncompress(reinterpret_cast<Bytef*>(to.data.get()), &size,
                                reinterpret_cast<const Bytef*>(block.data()), block.size());
  if (status != Z_OK || size != to.size) throw std::runtime_error("a grid is damaged");
}

void unpack_blosc(std::ifstream& file, uint64_t left, const GridBytes& to) {
  constexpr size_t chunk = size_t{1} << 30;  // as NanoVDB splits larger grids
  for (size_t done = 0; done < to.size;) {
    const size_t expected = std::min(chunk, to.size - done);
    const std::vector<char> block = read_block(file, left);
    size_t size = 0;
    if (blosc_cbuffer_validate(block.data(), block.size(), &size) != 0 || size != expected)
      throw std::runtime_error("a grid is damaged");
    const int count = blosc_decompress_ctx(block.data(), to.data.get() + done, expected, 1);
    if (count != static_cast<int>(expected)) throw std::runtime_error("a grid is damaged");
    done += expected;
  }
}

GridBytes unpack(std::ifstream& file, const NanoVdbEntry& entry) {
  // No codec packs better than this; a larger size is damage, not data.
  constexpr uint64_t best_ratio = 4096;
  if (entry.info.memory / best_ratio > entry.packed_size ||
      entry.info.memory < sizeof(nanovdb::GridData))
    throw std::runtime_error("its directory is damaged");
  file.seekg(static_cast<std::streamoff>(entry.offset));
  GridBytes bytes = allocate(entry.info.memory);
  if (entry.codec == 0) {
    if (entry.packed_size < bytes.size)
      throw std::runtime_error("its directory is damaged");
    read_bytes(file, bytes.data.get(), bytes.size);
  } else if (entry.codec == 1) {
    unpack_zlib(file, entry.packed_size, bytes);
  } else if (entry.codec == 2) {
    unpack_blosc(file, entry.packed_size, bytes);
  } else {
    throw std::runtime_error(fmt::format("unknown compression {}", entry.codec));
  }
  return bytes;
}

// 8^3 voxels: a leaf, or a tile of one value.
template <typename Build>
struct Block {
  const typename nanovdb::NanoGrid<Build>::TreeType::LeafNodeType* leaf;
  float tile;

  bool is_zero() const { return !leaf && tile == 0; }
  float value(int i) const {
    if (!leaf) return tile;
    const uint32_t n = static_cast<uint32_t>(i);
    return leaf->isActive(n) ? static_cast<float>(leaf->getValue(n)) : 0;
  }
};

template <typename Build>
PlacedGrid convert(const GridBytes& bytes) {
  const auto& grid = *reinterpret_cast<const nanovdb::NanoGrid<Build>*>(bytes.data.get());
  const auto& box = grid.indexBBox();
  if (box.min()[0] > box.max()[0]) return empty_grid();
  const BrickLayout layout = lay_out_bricks({box.min()[0], box.min()[1], box.min()[2]},
                                            {box.max()[0], box.max()[1], box.max()[2]});
  const auto source = [&](Vec3i brick, BrickGrid::Samples samples) {
    const auto& root = grid.tree().root();
    return fill_brick(layout, brick, samples, [&](Vec3i voxel) {
      const nanovdb::Coord at(voxel.x, voxel.y, voxel.z);
      const auto* leaf = root.probeLeaf(at);
      const bool has_tile = !leaf && root.isActive(at);
      return Block<Build>{leaf, has_tile ? static_cast<float>(root.getValue(at)) : 0};
    });
  };
  const nanovdb::Map& map = grid.map();
  Matrix4 m{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) m[i][j] = static_cast<float>(map.mMatD[3 * i + j]);
    m[i][3] = static_cast<float>(map.mVecD[i]);
  }
  m[3][3] = 1;
  return place_bricks(layout, m, source);
}

}  // namespace

PlacedGrid read_nanovdb_grid(std::ifstream& file, const NanoVdbEntry& entry) {
  const GridBytes bytes = unpack(file, entry);
  const auto& header = *reinterpret_cast<const nanovdb::GridData*>(bytes.data.get());
  if (header.mMagic != NANOVDB_MAGIC_NUMBER || header.mGridSize > bytes.size ||
      static_cast<uint32_t>(header.mGridType) != entry.type)
    throw std::runtime_error("a grid is damaged");
  switch (header.mGridType) {
    case nanovdb::GridType::Float:
      return convert<float>(bytes);
    case nanovdb::GridType::Double:
      return convert<double>(bytes);
    case nanovdb::GridType::Fp4:
      return convert<nanovdb::Fp4>(bytes);
    case nanovdb::GridType::Fp8:
      return convert<nanovdb::Fp8>(bytes);
    case nanovdb::GridType::Fp16:
      return convert<nanovdb::Fp16>(bytes);
    case nanovdb::GridType::FpN:
      return convert<nanovdb::FpN>(bytes);
    default:
      throw std::runtime_error(
          fmt::format("grids of type {} hold no density", entry.info.type));
  }
}

}  // namespace tyndall
