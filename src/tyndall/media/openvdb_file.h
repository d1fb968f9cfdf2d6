// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tyndall/media/placed_grid.h"
#include "tyndall/media/volume_file.h"

namespace tyndall {

/// What the directory of a .vdb file says of a grid.
struct OpenVdbEntry {
  std::string name, compression;
};

/// The directory of a .vdb file, empty for formats older than 222. Throws
/// std::runtime_error without the file's name, also if the file is shorter than the
/// directory says: the library reads truncated files without a word.
std::vector<OpenVdbEntry> read_openvdb_directory(std::ifstream& file);

/// The grids of a .vdb file. Throws std::runtime_error without the file's name.
std::vector<VolumeGridInfo> list_openvdb_grids(const std::filesystem::path& path);

/// Only their names and types, which is much faster.
std::vector<VolumeGridInfo> list_openvdb_names(const std::filesystem::path& path);

/// Reads the grid called `name`. Throws std::runtime_error without the file's name.
PlacedGrid read_openvdb_grid(const std::filesystem::path& path, const std::string& name);

}  // namespace tyndall
