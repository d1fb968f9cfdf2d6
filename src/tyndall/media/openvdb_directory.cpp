// SPDX-License-Identifier: Apache-2.0
//
// The directory of .vdb files: a header, the file's metadata, and before each grid its
// name, type, parent, and the places where the grid begins and ends.
#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "tyndall/media/openvdb_file.h"

namespace tyndall {
namespace {

constexpr uint32_t oldest_version = 222, newest_version = 224;

template <typename T>
T read(std::ifstream& file) {
  T value{};
  if (!file.read(reinterpret_cast<char*>(&value), sizeof value))
    throw std::runtime_error("the file ends within its directory");
  return value;
}

void skip(std::ifstream& file, int64_t size) { file.seekg(size, std::ios::cur); }

std::string read_string(std::ifstream& file) {
  const uint32_t size = read<uint32_t>(file);
  if (size > 1 << 20) throw std::runtime_error("its directory is damaged");
  std::string text(size, ' ');
  if (!file.read(text.data(), size))
    throw std::runtime_error("the file ends within its directory");
  return text;
}

void skip_metadata(std::ifstream& file, int64_t size) {
  for (uint32_t count = read<uint32_t>(file); count > 0; --count) {
    read_string(file);  // name
    read_string(file);  // type
    const uint32_t value_size = read<uint32_t>(file);
    if (value_size > size - file.tellg())
      throw std::runtime_error("its directory is damaged");
    skip(file, value_size);
  }
}

bool is_type_name(const std::string& text) {
  constexpr const char* letters =
      "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ_abcdefghijklmnopqrstuvwxyz";
  return text.find_first_not_of(letters) == std::string::npos;
}

OpenVdbEntry read_entry(std::ifstream& file) {
  OpenVdbEntry entry;
  const std::string name = read_string(file);
  entry.name = name.substr(0, name.find('\x1e'));
  entry.type = read_string(file);
  entry.is_instance = !read_string(file).empty();
  entry.begin = read<int64_t>(file);
  skip(file, 8);  // where the voxels begin
  entry.end = read<int64_t>(file);
  return entry;
}

}  // namespace

std::vector<OpenVdbEntry> read_openvdb_directory(std::ifstream& file) {
  file.seekg(0, std::ios::end);
  const int64_t size = file.tellg();
  file.seekg(8);
  const uint32_t version = read<uint32_t>(file);
  skip(file, 8);  // version of the library
  const bool has_offsets = read<char>(file) != 0;
  std::vector<OpenVdbEntry> entries;
  if (version < oldest_version || version > newest_version || !has_offsets) return entries;
  skip(file, 36);  // identifier
  skip_metadata(file, size);
  for (uint32_t count = read<uint32_t>(file); count > 0; --count) {
    entries.push_back(read_entry(file));
    OpenVdbEntry& entry = entries.back();
    if (entry.end > size)
      throw std::runtime_error(
          fmt::format("it is truncated: grid \"{}\" ends at byte {} of {}", entry.name,
                      entry.end, size));
    // Grids lie in a row, each behind its entry.
    if (!is_type_name(entry.type) || entry.begin < file.tellg() || entry.end < entry.begin)
      throw std::runtime_error("its directory is damaged");
    file.seekg(entry.begin);
    constexpr uint32_t zip = 1, blosc = 4;
    const uint32_t flags = read<uint32_t>(file);
    entry.compression = flags & blosc ? "blosc" : flags & zip ? "zip" : "none";
    file.seekg(entry.end);
  }
  return entries;
}

}  // namespace tyndall
