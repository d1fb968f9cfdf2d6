// SPDX-License-Identifier: Apache-2.0
//
// A grid of a .vdb file: how it is packed, its metadata, its transform, and a tree. First
// come the tree's masks and the values of its inner nodes, then the values of its leaves,
// both from the first node to the last.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include "tyndall/media/openvdb_file.h"
#include "tyndall/media/openvdb_values.h"

namespace tyndall {
namespace {

struct SizeOfType {
  std::string_view name;
  uint32_t size;
};

// The size that the library reads, whatever the file says of it.
constexpr SizeOfType metadata_types[] = {
    {"bool", 1},   {"int32", 4},  {"int64", 8},  {"float", 4},
    {"double", 8}, {"vec2i", 8},  {"vec2s", 8},  {"vec2d", 16},
    {"vec3i", 12}, {"vec3s", 12}, {"vec3d", 24}, {"vec4i", 16},
    {"vec4s", 16}, {"vec4d", 32}, {"mat4s", 64}, {"mat4d", 128}};

constexpr SizeOfType maps[] = {
    {"TranslationMap", 24}, {"ScaleMap", 120},          {"UniformScaleMap", 120},
    {"AffineMap", 128},     {"ScaleTranslateMap", 144}, {"UniformScaleTranslateMap", 144},
    {"UnitaryMap", 128}};

constexpr SizeOfType value_types[] = {{"float", 4},  {"double", 8}, {"int32", 4},
                                      {"int64", 8},  {"vec3i", 12}, {"vec3s", 12},
                                      {"vec3d", 24}, {"bool", 1},   {"mask", 1}};

template <size_t N>
const SizeOfType* find_type(const SizeOfType (&types)[N], std::string_view name) {
  const auto* found = std::find_if(std::begin(types), std::end(types),
                                   [&](const SizeOfType& t) { return t.name == name; });
  return found == std::end(types) ? nullptr : found;
}

// Returns whether numbers are saved as halves.
bool pass_metadata(OpenVdbBytes& bytes) {
  bool is_half = false;
  for (uint32_t count = bytes.number<uint32_t>(); count > 0; --count) {
    const std::string name = bytes.text(), type = bytes.text();
    const uint32_t size = bytes.number<uint32_t>();
    const SizeOfType* known = find_type(metadata_types, type);
    OpenVdbBytes::require(!name.empty() && (!known || known->size == size));
    if (name == "is_saved_as_half_float" && type == "bool")
      is_half = bytes.number<uint8_t>() != 0;
    else
      bytes.skip(size);
  }
  return is_half;
}

void pass_map(OpenVdbBytes& bytes) {
  std::string type = bytes.text();
  if (type == "NonlinearFrustumMap") {
    bytes.skip(64);  // its box, taper and depth; then another map
    type = bytes.text();
  }
  const SizeOfType* known = find_type(maps, type);
  OpenVdbBytes::require(known != nullptr);
  bytes.skip(known->size);
}

// Trees that are four levels deep, as all are that the library itself makes.
class TreeCheck {
 public:
  TreeCheck(OpenVdbBytes& bytes, std::string_view type, OpenVdbValues values)
      : bytes_(bytes), type_(type), value_size_(values.size), values_(bytes, values) {}

  void pass() {
    pass_root();
    for (const uint32_t active_count : leaves_) pass_leaf_values(active_count);
  }

 private:
  // Of a leaf, and of the two kinds of inner nodes.
  static constexpr std::array<uint32_t, 3> sizes{512, 4096, 32768};

  void pass_root() {
    constexpr int32_t edge = 4096;
    OpenVdbBytes::require(bytes_.number<uint32_t>() == 1);  // buffers of values
    bytes_.skip(value_size_);                               // of voxels that are not stored
    const uint64_t tiles = bytes_.number<uint32_t>();
    const uint32_t children = bytes_.number<uint32_t>();
    bytes_.skip(tiles * (13 + value_size_));  // position, value, whether it is active
    for (uint32_t i = 0; i < children; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        OpenVdbBytes::require(bytes_.number<int32_t>() % edge == 0);
      pass_node(2);
    }
  }

  void pass_node(size_t level) {
    if (level == 0) return leaves_.push_back(pass_mask(sizes[0]));
    const uint32_t children = pass_mask(sizes[level]), active = pass_mask(sizes[level]);
    values_.pass(sizes[level], active, true);
    for (uint32_t i = 0; i < children; ++i) pass_node(level - 1);
  }

  // Returns how many of its bits are set.
  uint32_t pass_mask(uint32_t bits) {
    mask_.resize(bits / 64);
    bytes_.read(std::as_writable_bytes(std::span(mask_)));
    uint32_t count = 0;
    for (const uint64_t word : mask_) count += static_cast<uint32_t>(std::popcount(word));
    return count;
  }

  void pass_leaf_values(uint32_t active_count) {
    OpenVdbBytes::require(pass_mask(sizes[0]) == active_count);
    if (type_ == "mask") return;
    if (type_ == "bool") return bytes_.skip(sizes[0] / 8);
    values_.pass(sizes[0], active_count, false);
  }

  OpenVdbBytes& bytes_;
  std::string_view type_;
  uint32_t value_size_;
  OpenVdbValueCheck values_;
  std::vector<uint32_t> leaves_;  // how many voxels of each are active
  std::vector<uint64_t> mask_;
};

// "float" of "Tree_float_5_4_3_HalfFloat"; empty if the tree is of another shape.
std::string_view value_type(std::string_view tree) {
  constexpr std::string_view begin = "Tree_", end = "_5_4_3", half = "_HalfFloat";
  if (tree.ends_with(half)) tree.remove_suffix(half.size());
  if (!tree.starts_with(begin) || !tree.ends_with(end)) return {};
  tree.remove_suffix(end.size());
  return tree.substr(std::min(begin.size(), tree.size()));
}

void check(std::ifstream& file, const OpenVdbEntry& entry, bool with_tree) {
  OpenVdbBytes bytes(file, entry.begin, entry.end);
  const uint32_t flags = bytes.number<uint32_t>();
  const bool is_half = pass_metadata(bytes);
  OpenVdbBytes::require(is_half == entry.type.ends_with("_HalfFloat"));
  pass_map(bytes);
  const SizeOfType* type = find_type(value_types, value_type(entry.type));
  if (!with_tree || entry.is_instance || !type) return;
  const bool has_halves = type->name.starts_with("vec3s") ||
                          type->name.starts_with("vec3d") || type->name == "float" ||
                          type->name == "double";
  const uint32_t numbers = type->name.starts_with("vec3") ? 3 : 1;
  const uint32_t stored_size = is_half && has_halves ? 2 * numbers : type->size;
  TreeCheck(bytes, type->name, {type->size, stored_size, flags}).pass();
}

}  // namespace

void check_openvdb_grid(std::ifstream& file, const OpenVdbEntry& entry, bool with_tree) {
  try {
    check(file, entry, with_tree);
  } catch (const std::runtime_error&) {
    throw std::runtime_error(fmt::format("grid \"{}\" is damaged", entry.name));
  }
}

}  // namespace tyndall
