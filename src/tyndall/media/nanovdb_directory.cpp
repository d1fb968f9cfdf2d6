// SPDX-License-Identifier: Apache-2.0
//
// The container of .nvdb files: segments of a 16-byte header, the grids' metadata with
// their names, and the grids, packed one after the other.
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "tyndall/media/nanovdb_file.h"

namespace tyndall {
namespace {

constexpr char magic[8] = {'N', 'a', 'n', 'o', 'V', 'D', 'B', '0'};
constexpr uint32_t supported_version = 32;
constexpr size_t metadata_size = 176;
constexpr uint32_t longest_name = 1 << 16;

constexpr std::array<const char*, 20> type_names{
    "unknown", "float",   "double", "int16",  "int32", "int64", "vec3s",
    "vec3d",   "mask",    "half",   "uint32", "bool",  "rgba8", "float4",
    "float8",  "float16", "floatN", "vec4s",  "vec4d", "index"};

constexpr bool is_scalar(uint32_t type) {
  return type == 1 || type == 2 || (type >= 13 && type <= 16);
}

// Bytes read from a file, taken apart by offset.
class Record {
 public:
  Record(std::ifstream& file, size_t size) : bytes_(size) {
    if (!file.read(bytes_.data(), static_cast<std::streamsize>(size)))
      throw std::runtime_error("the file ends within its directory");
  }
  template <typename T>
  T at(size_t offset) const {
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }
  std::string text() const {
    return {bytes_.data(), ::strnlen(bytes_.data(), bytes_.size())};
  }
  bool begins_with_magic() const {
    return std::memcmp(bytes_.data(), magic, sizeof magic) == 0;
  }

 private:
  std::vector<char> bytes_;
};

Vec3 narrow(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

VolumeGridInfo make_info(const Record& r, uint32_t type) {
  const auto number = [&](size_t i) { return r.at<double>(i); };
  const auto voxel = [&](size_t i) {
    return Vec3i{r.at<int32_t>(i), r.at<int32_t>(i + 4), r.at<int32_t>(i + 8)};
  };
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  return {.name = {},
          .type = type < type_names.size() ? type_names[type] : "unknown",
          .is_scalar = is_scalar(type),
          .first = voxel(88),
          .last = voxel(100),
          .bounds = {narrow(number(40), number(48), number(56)),
                     narrow(number(64), number(72), number(80))},
          .voxel_size = narrow(number(112), number(120), number(128)),
          .active_voxels = r.at<uint64_t>(24),
          .memory = r.at<uint64_t>(0),
          .min = unknown,
          .max = unknown};
}

NanoVdbEntry read_entry(std::ifstream& file) {
  constexpr uint32_t level_set = 1, point_index = 3, point_data = 4;  // nanovdb::GridClass
  const Record r(file, metadata_size);
  const uint32_t type = r.at<uint32_t>(32), grid_class = r.at<uint32_t>(36);
  NanoVdbEntry entry{.info = make_info(r, type),
                     .type = type,
                     .codec = r.at<uint16_t>(168),
                     .offset = 0,
                     .packed_size = r.at<uint64_t>(8)};
  if (grid_class == point_index || grid_class == point_data) {
    entry.info.type = "points";
    entry.info.is_scalar = false;
  }
  entry.info.is_level_set = grid_class == level_set;
  const uint32_t name_size = r.at<uint32_t>(136);
  if (name_size > longest_name) throw std::runtime_error("its directory is damaged");
  entry.info.name = Record(file, name_size).text();
  constexpr std::array<const char*, 3> codecs{"none", "zip", "blosc"};
  if (entry.codec < codecs.size()) entry.info.compression = codecs[entry.codec];
  return entry;
}

void check_version(const Record& header) {
  const uint32_t version = header.at<uint32_t>(8);
  const uint32_t major = version >> 21;
  if (major != supported_version)
    throw std::runtime_error(fmt::format(
        "it was written by NanoVDB {}, only {}.x can be read; convert it anew with "
        "nanovdb_convert",
        major == 0 ? "before 32" : std::to_string(major), supported_version));
}

uint64_t size_of(std::ifstream& file) {
  file.seekg(0, std::ios::end);
  return static_cast<uint64_t>(file.tellg());
}

}  // namespace

std::vector<NanoVdbEntry> read_nanovdb_directory(std::ifstream& file) {
  const uint64_t size = size_of(file);
  std::vector<NanoVdbEntry> entries;
  uint64_t position = 0;
  while (position < size) {
    file.seekg(static_cast<std::streamoff>(position));
    const Record header(file, 16);
    if (!header.begins_with_magic()) throw std::runtime_error("it is no NanoVDB file");
    check_version(header);
    const size_t begin = entries.size();
    for (int i = header.at<uint16_t>(12); i > 0; --i) entries.push_back(read_entry(file));
    position = static_cast<uint64_t>(file.tellg());
    for (size_t i = begin; i < entries.size(); ++i) {
      if (entries[i].packed_size > size - position)
        throw std::runtime_error(
            fmt::format("it is truncated: grid \"{}\" needs {} bytes, {} are left",
                        entries[i].info.name, entries[i].packed_size, size - position));
      entries[i].offset = position;
      position += entries[i].packed_size;
    }
  }
  return entries;
}

}  // namespace tyndall
