// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <stdexcept>

namespace tyndall::loader {
namespace {

[[noreturn]] void broken(const std::string& reason) { throw std::runtime_error(reason); }

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> result;
  constexpr std::string_view blanks = " \t\r";
  for (size_t at = 0; (at = line.find_first_not_of(blanks, at)) != line.npos;) {
    const size_t end = std::min(line.find_first_of(blanks, at), line.size());
    result.push_back(line.substr(at, end - at));
    at = end;
  }
  return result;
}

PlyType type_by_name(std::string_view name) {
  struct Name {
    std::string_view name;
    PlyType type;
  };
  constexpr std::array names{
      Name{"char", PlyType::int8},      Name{"int8", PlyType::int8},
      Name{"uchar", PlyType::uint8},    Name{"uint8", PlyType::uint8},
      Name{"short", PlyType::int16},    Name{"int16", PlyType::int16},
      Name{"ushort", PlyType::uint16},  Name{"uint16", PlyType::uint16},
      Name{"int", PlyType::int32},      Name{"int32", PlyType::int32},
      Name{"uint", PlyType::uint32},    Name{"uint32", PlyType::uint32},
      Name{"float", PlyType::float32},  Name{"float32", PlyType::float32},
      Name{"double", PlyType::float64}, Name{"float64", PlyType::float64}};
  for (const Name& entry : names)
    if (entry.name == name) return entry.type;
  broken(fmt::format("the PLY header has an unknown type \"{}\"", name.substr(0, 40)));
}

PlyFormat format_by_name(std::string_view name) {
  if (name == "ascii") return PlyFormat::ascii;
  if (name == "binary_little_endian") return PlyFormat::binary_little_endian;
  if (name == "binary_big_endian") return PlyFormat::binary_big_endian;
  broken(fmt::format("the PLY header has an unknown format \"{}\"", name.substr(0, 40)));
}

bool is_integer(PlyType type) {
  return type != PlyType::float32 && type != PlyType::float64;
}

PlyElement element_of(const std::vector<std::string_view>& line) {
  PlyElement element;
  if (line.size() != 3) broken("the PLY header has an element without name or count");
  element.name = line[1];
  const char* const end = line[2].data() + line[2].size();
  const auto [at, error] = std::from_chars(line[2].data(), end, element.count);
  if (at != end || error != std::errc{})
    broken(fmt::format("the PLY header has \"{}\" elements \"{}\"", line[2].substr(0, 40),
                       element.name));
  return element;
}

PlyProperty property_of(const std::vector<std::string_view>& line) {
  const bool is_list = line.size() == 5 && line[1] == "list";
  if (!is_list && line.size() != 3)
    broken("the PLY header has a property without type or name");
  PlyProperty property{std::string(line.back()), type_by_name(line[line.size() - 2]),
                       is_list};
  if (!is_list) return property;
  property.count_type = type_by_name(line[2]);
  if (!is_integer(property.count_type))
    broken(fmt::format("the PLY header has a list \"{}\" whose count is not an integer",
                       property.name));
  return property;
}

void add_line(PlyHeader& header, const std::vector<std::string_view>& line,
              bool& has_format) {
  if (line.empty() || line[0] == "comment" || line[0] == "obj_info") return;
  if (line[0] == "format" && line.size() >= 2) {
    header.format = format_by_name(line[1]);
    has_format = true;
  } else if (line[0] == "element") {
    header.elements.push_back(element_of(line));
  } else if (line[0] == "property") {
    if (header.elements.empty()) broken("the PLY header has a property before any element");
    header.elements.back().properties.push_back(property_of(line));
  } else {
    broken(fmt::format("the PLY header has an unknown line \"{}\"", line[0].substr(0, 40)));
  }
}

}  // namespace

size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 0;
}

PlyHeader read_ply_header(std::string_view bytes) {
  PlyHeader header;
  bool is_first = true, has_format = false;
  for (size_t at = 0; at < bytes.size();) {
    const size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::vector<std::string_view> line = words(bytes.substr(at, end - at));
    at = std::min(end + 1, bytes.size());
    if (is_first && (line.size() != 1 || line[0] != "ply")) broken("it is not a PLY file");
    if (!is_first && line.size() == 1 && line[0] == "end_header") {
      if (!has_format) broken("the PLY header has no format");
      header.size = at;
      return header;
    }
    if (!is_first) add_line(header, line, has_format);
    is_first = false;
  }
  broken(bytes.empty() ? "it is empty" : "the PLY header has no end");
}

}  // namespace tyndall::loader
