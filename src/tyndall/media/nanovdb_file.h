// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "tyndall/media/placed_grid.h"
#include "tyndall/media/volume_file.h"

namespace tyndall {

/// Where a grid lies in a .nvdb file, and how it is packed.
struct NanoVdbEntry {
  VolumeGridInfo info;
  uint32_t type;         ///< nanovdb::GridType
  uint16_t codec;        ///< 0 none, 1 zlib, 2 blosc
  uint64_t offset;       ///< of the packed grid in the file [bytes]
  uint64_t packed_size;  ///< [bytes]
};

/// The directory of a .nvdb file. Throws std::runtime_error without the file's name.
std::vector<NanoVdbEntry> read_nanovdb_directory(std::ifstream& file);

/// Fills in the bounds and, if the grid says them, the least and the largest value. Throws
/// std::runtime_error without the file's name.
void read_nanovdb_details(std::ifstream& file, const NanoVdbEntry& entry,
                          VolumeGridInfo& info);

/// Reads one grid. Throws std::runtime_error without the file's name.
PlacedGrid read_nanovdb_grid(std::ifstream& file, const NanoVdbEntry& entry);

}  // namespace tyndall
