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
  std::string type;            ///< of the tree, "Tree_float_5_4_3"
  bool is_instance = false;    ///< it has the tree of another grid
  int64_t begin = 0, end = 0;  ///< of the grid in the file [bytes]
};

/// The directory of a .vdb file, empty for formats older than 222. Throws
/// std::runtime_error without the file's name, also if the file is shorter than the
/// directory says: the library reads truncated files without a word.
std::vector<OpenVdbEntry> read_openvdb_directory(std::ifstream& file);

/// Throws std::runtime_error without the file's name if a grid is damaged in a way that
/// crashes the library, hangs it, or makes it take memory without bounds: sizes that do
/// not fit, and inner nodes that cannot be unpacked. Looks at the grid's header, or at its
/// tree too; trees of points, of strings and of other depths it does not know.
void check_openvdb_grid(std::ifstream& file, const OpenVdbEntry& entry, bool with_tree);

/// The grids of a .vdb file. Throws std::runtime_error without the file's name.
std::vector<VolumeGridInfo> list_openvdb_grids(const std::filesystem::path& path);

/// Only their names and types, which is much faster.
std::vector<VolumeGridInfo> list_openvdb_names(const std::filesystem::path& path);

/// Reads the grid called `name`. Throws std::runtime_error without the file's name.
PlacedGrid read_openvdb_grid(const std::filesystem::path& path, const std::string& name);

}  // namespace tyndall
