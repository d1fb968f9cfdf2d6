// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/volume_info.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tyndall/loader/excerpt.h"

namespace tyndall::app {
namespace {

bool is_empty(const VolumeGridInfo& grid) { return grid.first.x > grid.last.x; }

// Positions may be as far apart as 32 bits can say.
std::array<int64_t, 3> voxel_count(const VolumeGridInfo& grid) {
  if (is_empty(grid)) return {0, 0, 0};
  const auto count = [](int first, int last) { return int64_t{last} - first + 1; };
  return {count(grid.first.x, grid.last.x), count(grid.first.y, grid.last.y),
          count(grid.first.z, grid.last.z)};
}

std::string grid_text(const VolumeGridInfo& grid) {
  const std::array<int64_t, 3> n = voxel_count(grid);
  const Vec3 s = grid.voxel_size, a = grid.bounds.min, b = grid.bounds.max;
  std::string text =
      fmt::format("  \"{}\": {}{}{}\n", loader::printable(grid.name),
                  loader::printable(grid.type), grid.is_level_set ? ", a level set" : "",
                  grid.is_scalar ? "" : ", which cannot be a density or a temperature");
  text += fmt::format("    voxels    {} active in {} x {} x {}\n", grid.active_voxels, n[0],
                      n[1], n[2]);
  text += fmt::format("    voxel     {:g} x {:g} x {:g}\n", s.x, s.y, s.z);
  if (!is_empty(grid))
    text += fmt::format("    bounds    ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})\n", a.x,
                        a.y, a.z, b.x, b.y, b.z);
  if (std::isfinite(grid.min) && std::isfinite(grid.max))
    text += fmt::format("    values    {:g} to {:g}\n", grid.min, grid.max);
  return text + fmt::format("    memory    {}, compression {}\n", short_bytes(grid.memory),
                            grid.compression);
}

nlohmann::ordered_json triple(Vec3 v) { return {v.x, v.y, v.z}; }
nlohmann::ordered_json number(float x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json();
}

nlohmann::ordered_json grid_json(const VolumeGridInfo& grid) {
  nlohmann::ordered_json json = {{"name", grid.name},
                                 {"type", grid.type},
                                 {"is_scalar", grid.is_scalar},
                                 {"is_level_set", grid.is_level_set},
                                 {"active_voxels", grid.active_voxels},
                                 {"voxels", voxel_count(grid)},
                                 {"voxel_size", triple(grid.voxel_size)},
                                 {"bounds", nullptr},
                                 {"min", number(grid.min)},
                                 {"max", number(grid.max)},
                                 {"memory_bytes", grid.memory},
                                 {"compression", grid.compression}};
  if (!is_empty(grid)) json["bounds"] = {triple(grid.bounds.min), triple(grid.bounds.max)};
  return json;
}

}  // namespace

std::string short_bytes(uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  const double value = static_cast<double>(bytes);
  if (bytes < 1000'000) return fmt::format("{:.3g} kB", value * 1e-3);
  if (bytes < 1000'000'000) return fmt::format("{:.3g} MB", value * 1e-6);
  return fmt::format("{:.3g} GB", value * 1e-9);
}

std::string volume_text(const std::string& path, const std::vector<VolumeGridInfo>& grids) {
  std::string text = fmt::format("{}: {} in the file, {} grid{}\n", path,
                                 short_bytes(std::filesystem::file_size(path)),
                                 grids.size(), grids.size() == 1 ? "" : "s");
  for (const VolumeGridInfo& grid : grids) text += grid_text(grid);
  return text;
}

nlohmann::ordered_json volume_json(const std::string& path,
                                   const std::vector<VolumeGridInfo>& grids) {
  nlohmann::ordered_json json = {{"file", path},
                                 {"kind", "volume"},
                                 {"file_bytes", std::filesystem::file_size(path)},
                                 {"grids", nlohmann::ordered_json::array()}};
  for (const VolumeGridInfo& grid : grids) json["grids"].push_back(grid_json(grid));
  return json;
}

}  // namespace tyndall::app
