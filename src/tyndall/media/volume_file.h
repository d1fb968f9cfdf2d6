// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/math/bounds.h"
#include "tyndall/math/vec.h"
#include "tyndall/media/placed_grid.h"

namespace tyndall {

/// What a volume file says of one of its grids.
struct VolumeGridInfo {
  std::string name;
  std::string type;   ///< "float", "vec3s", "points" ...
  bool is_scalar;     ///< whether read_volume() takes it
  Vec3i first, last;  ///< active voxels, inclusive; first > last if there are none
  Bounds3 bounds;     ///< of the active voxels, cubes about their positions, in the file's
                      ///< space; what is read fades to zero half a voxel farther out
  Vec3 voxel_size;    ///< in the file's space
  uint64_t active_voxels;
  uint64_t memory;            ///< uncompressed, as the file stores it [bytes]
  float min, max;             ///< of the active voxels; NaN if not known
  std::string compression{};  ///< in the file: "none", "zip", "blosc"; empty if not known
  bool is_level_set = false;  ///< its numbers are distances to a surface
};

/// The grids of a .vdb or .nvdb file, told apart by their contents.
/// Throws std::runtime_error that names the file if it cannot be read. OpenVDB crashes on
/// what is damaged of grids of points and of files of versions before 222, see
/// VolumeInHand; all else is checked before.
std::vector<VolumeGridInfo> list_volume_grids(const std::filesystem::path& path);

/// Only names and types are sure to be filled in, which is much faster.
/// Throws std::runtime_error that names the file if it cannot be read.
std::vector<VolumeGridInfo> list_volume_names(const std::filesystem::path& path);

/// Reads the first grid of the file that has one of `names`, in their order of preference,
/// or its only grid if that has no name; its medium space is the file's. Level sets become
/// densities, see PlacedGrid::is_from_level_set. Inactive voxels count as zero, and so does
/// what is negative, infinite or not a number: see BrickGrid::rejected(). Throws
/// std::runtime_error that names the file, and the grids found if none has the name.
PlacedGrid read_volume(const std::filesystem::path& path,
                       std::span<const std::string_view> names);

/// As read_volume(), but empty if no grid of numbers has one of the names.
std::optional<PlacedGrid> read_volume_if_any(const std::filesystem::path& path,
                                             std::span<const std::string_view> names);

/// Names of grids that mean a temperature, in order of preference.
inline constexpr std::string_view temperature_grid_names[] = {"temperature", "flame",
                                                              "flames", "heat"};

}  // namespace tyndall
