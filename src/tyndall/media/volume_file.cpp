// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/volume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "tyndall/media/nanovdb_file.h"
#include "tyndall/media/openvdb_file.h"
#include "tyndall/media/volume_in_hand.h"

namespace tyndall {
namespace {

enum class Container { nanovdb, openvdb };

Container container_of(std::ifstream& file) {
  constexpr std::array<char, 8> openvdb_magic{' ', 'B', 'D', 'V', 0, 0, 0, 0};
  constexpr std::array<char, 7> nanovdb_magic{'N', 'a', 'n', 'o', 'V', 'D', 'B'};
  std::array<char, 8> head{};
  file.read(head.data(), head.size());
  file.clear();
  if (head == openvdb_magic) {
    for (const OpenVdbEntry& entry : read_openvdb_directory(file))
      check_openvdb_grid(file, entry, /*with_tree=*/false);
    return Container::openvdb;
  }
  if (std::equal(nanovdb_magic.begin(), nanovdb_magic.end(), head.begin()))
    return Container::nanovdb;
  throw std::runtime_error("it is neither an OpenVDB nor a NanoVDB file");
}

// Opens the file, hands it to f, and puts the file's name before what goes wrong.
template <typename F>
auto with_volume(const std::filesystem::path& path, F&& f) {
  try {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(std::strerror(errno));
    const VolumeInHand in_hand(path);
    return f(file, container_of(file));
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: not enough memory", path.string()));
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), e.what()));
  }
}

std::string list_names(const std::vector<VolumeGridInfo>& grids) {
  std::string list;
  for (const VolumeGridInfo& grid : grids)
    list += fmt::format("{}\"{}\" ({})", list.empty() ? "" : ", ", grid.name, grid.type);
  return list.empty() ? "no grids" : list;
}

// The first grid with a name of the list; null if there is none.
const VolumeGridInfo* find_name(const std::vector<VolumeGridInfo>& grids,
                                std::span<const std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found =
        std::find_if(grids.begin(), grids.end(),
                     [&](const VolumeGridInfo& g) { return g.name == name; });
    if (found != grids.end()) return &*found;
  }
  return nullptr;
}

// The index of the grid that read_volume() reads.
size_t find_grid(const std::vector<VolumeGridInfo>& grids,
                 std::span<const std::string_view> names) {
  const bool is_only_one = grids.size() == 1 && grids[0].name.empty() && grids[0].is_scalar;
  if (is_only_one) return 0;
  const VolumeGridInfo* found = find_name(grids, names);
  if (!found)
    throw std::runtime_error(fmt::format("there is no grid \"{}\"; the file has {}",
                                         names.empty() ? "" : names.front(),
                                         list_names(grids)));
  if (!found->is_scalar)
    throw std::runtime_error(fmt::format(
        "grid \"{}\" is of type {}, a grid of numbers is needed; the file has {}",
        found->name, found->type, list_names(grids)));
  return static_cast<size_t>(found - grids.data());
}

std::vector<VolumeGridInfo> infos_of(const std::vector<NanoVdbEntry>& entries) {
  std::vector<VolumeGridInfo> infos;
  infos.reserve(entries.size());
  for (const NanoVdbEntry& entry : entries) infos.push_back(entry.info);
  return infos;
}

}  // namespace

std::vector<VolumeGridInfo> list_volume_grids(const std::filesystem::path& path) {
  return with_volume(path, [&](std::ifstream& file, Container container) {
    std::vector<VolumeGridInfo> infos;
    if (container == Container::openvdb) {
      const std::vector<OpenVdbEntry> entries = read_openvdb_directory(file);
      for (const OpenVdbEntry& entry : entries) check_openvdb_grid(file, entry, true);
      infos = list_openvdb_grids(path);
      for (const OpenVdbEntry& entry : entries)
        for (VolumeGridInfo& info : infos)
          if (info.name == entry.name) info.compression = entry.compression;
    } else {
      for (const NanoVdbEntry& entry : read_nanovdb_directory(file)) {
        infos.push_back(entry.info);
        read_nanovdb_details(file, entry, infos.back());
      }
    }
    return infos;
  });
}

std::vector<VolumeGridInfo> list_volume_names(const std::filesystem::path& path) {
  return with_volume(path, [&](std::ifstream& file, Container container) {
    return container == Container::openvdb ? list_openvdb_names(path)
                                           : infos_of(read_nanovdb_directory(file));
  });
}

PlacedGrid read_volume(const std::filesystem::path& path,
                       std::span<const std::string_view> names) {
  return with_volume(path, [&](std::ifstream& file, Container container) {
    if (container == Container::openvdb) {
      const std::vector<VolumeGridInfo> grids = list_openvdb_names(path);
      const std::string& name = grids[find_grid(grids, names)].name;
      for (const OpenVdbEntry& entry : read_openvdb_directory(file))
        if (entry.name == name) check_openvdb_grid(file, entry, true);
      return read_openvdb_grid(path, name);
    }
    const std::vector<NanoVdbEntry> entries = read_nanovdb_directory(file);
    return read_nanovdb_grid(file, entries[find_grid(infos_of(entries), names)]);
  });
}

std::optional<PlacedGrid> read_volume_if_any(const std::filesystem::path& path,
                                             std::span<const std::string_view> names) {
  std::vector<VolumeGridInfo> grids = list_volume_names(path);
  std::erase_if(grids, [](const VolumeGridInfo& grid) { return !grid.is_scalar; });
  const VolumeGridInfo* found = find_name(grids, names);
  if (!found) return std::nullopt;
  const std::string_view name[] = {found->name};
  return read_volume(path, name);
}

}  // namespace tyndall
