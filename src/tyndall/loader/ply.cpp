// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "tyndall/loader/ply_header.h"
#include "tyndall/loader/ply_values.h"

namespace tyndall::loader {

double PlyValues::next_bytes(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return next_as<int8_t>();
    case PlyType::uint8:
      return next_as<uint8_t>();
    case PlyType::int16:
      return next_as<int16_t>();
    case PlyType::uint16:
      return next_as<uint16_t>();
    case PlyType::int32:
      return next_as<int32_t>();
    case PlyType::uint32:
      return next_as<uint32_t>();
    case PlyType::float32:
      return next_as<float>();
    case PlyType::float64:
      return next_as<double>();
  }
  return 0;
}

double PlyValues::next_word() {
  const auto is_blank = [](char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
  };
  while (at_ < data_.size() && is_blank(data_[at_])) ++at_;
  if (at_ == data_.size()) throw std::runtime_error("the PLY data end too early");
  size_t end = at_;
  while (end < data_.size() && !is_blank(data_[end])) ++end;
  const std::string_view word = data_.substr(at_, end - at_);
  double value = 0;
  const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (last != word.data() + word.size() || error == std::errc::invalid_argument)
    throw std::runtime_error(fmt::format(
        "the PLY data hold \"{}\" where a number is expected", word.substr(0, 40)));
  at_ = end;
  return value;
}

namespace {

// Which number of a vertex goes where; -1: the property is not there.
struct VertexLayout {
  std::array<int, 3> position{-1, -1, -1}, normal{-1, -1, -1};
  std::array<int, 2> uv{-1, -1};

  bool has_normals() const { return std::min({normal[0], normal[1], normal[2]}) >= 0; }
  bool has_uvs() const { return std::min(uv[0], uv[1]) >= 0; }
};

bool is_any_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

VertexLayout layout_of(const PlyElement& element) {
  VertexLayout layout;
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const std::string& name = element.properties[i].name;
    const int index = static_cast<int>(i);
    if (element.properties[i].is_list)
      throw std::runtime_error("the PLY vertices hold a list");
    if (name == "x") layout.position[0] = index;
    if (name == "y") layout.position[1] = index;
    if (name == "z") layout.position[2] = index;
    if (name == "nx") layout.normal[0] = index;
    if (name == "ny") layout.normal[1] = index;
    if (name == "nz") layout.normal[2] = index;
    if (is_any_of(name, {"u", "s", "texture_u", "texture_s"})) layout.uv[0] = index;
    if (is_any_of(name, {"v", "t", "texture_v", "texture_t"})) layout.uv[1] = index;
  }
  if (std::min({layout.position[0], layout.position[1], layout.position[2]}) < 0)
    throw std::runtime_error("the PLY vertices have no x, y and z");
  return layout;
}

// Never trust a count for an allocation: each item takes at least `item_size` bytes of the
// data.
void check_count(const PlyElement& element, size_t item_size, const PlyValues& values) {
  if (item_size > 0 && element.count > values.bytes_left() / item_size)
    throw std::runtime_error(
        fmt::format("the PLY data end too early: the header announces {} elements \"{}\"",
                    element.count, element.name));
}

// In ascii, a digit and a blank.
size_t smallest_size(const PlyElement& element, const PlyValues& values) {
  size_t size = 0;
  for (const PlyProperty& p : element.properties)
    size += values.is_ascii() ? 1 : size_of(p.is_list ? p.count_type : p.type);
  return size;
}

void read_vertices(const PlyElement& element, PlyValues& values, const Transform& placing,
                   PlyMesh& mesh) {
  const VertexLayout layout = layout_of(element);
  check_count(element, smallest_size(element, values), values);
  mesh.positions.reserve(element.count);
  std::vector<double> row(element.properties.size());
  const auto exact = [&](int i) { return row[static_cast<size_t>(i)]; };
  const auto at = [&](int i) { return static_cast<float>(exact(i)); };
  for (size_t i = 0; i < element.count; ++i) {
    for (size_t j = 0; j < row.size(); ++j)
      row[j] = values.next(element.properties[j].type);
    mesh.positions.push_back(to_float(
        placing.precise_point({exact(layout.position[0]), exact(layout.position[1]),
                               exact(layout.position[2])})));
    if (!is_finite(mesh.positions.back()))
      throw std::runtime_error(fmt::format("vertex {} of the PLY file is not finite", i));
    if (layout.has_normals())
      mesh.normals.push_back(
          {at(layout.normal[0]), at(layout.normal[1]), at(layout.normal[2])});
    if (layout.has_uvs()) mesh.uvs.push_back({at(layout.uv[0]), at(layout.uv[1])});
  }
}

size_t read_list_count(const PlyProperty& list, PlyValues& values) {
  const double count = values.next(list.count_type);
  if (!(count >= 0))
    throw std::runtime_error(
        fmt::format("the PLY data have a list \"{}\" of {} values", list.name, count));
  if (count > static_cast<double>(values.bytes_left()))
    throw std::runtime_error(fmt::format(
        "the PLY data end too early: a list \"{}\" announces {} values", list.name, count));
  return static_cast<size_t>(count);
}

void skip(const PlyProperty& property, PlyValues& values) {
  const size_t count = property.is_list ? read_list_count(property, values) : 1;
  for (size_t i = 0; i < count; ++i) values.next(property.type);
}

void read_corners(const PlyProperty& list, PlyValues& values, std::vector<int>& corners) {
  corners.resize(read_list_count(list, values));
  for (int& corner : corners) {
    const double index = values.next(list.type);
    if (!(index >= 0 && index <= std::numeric_limits<int>::max()))
      throw std::runtime_error(fmt::format("a PLY face has the vertex index {}", index));
    corner = static_cast<int>(index);
  }
}

void add_face(const std::vector<int>& corners, PlyMesh& mesh) {
  if (corners.size() < 3) mesh.has_skipped_faces = true;
  for (size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void read_faces(const PlyElement& element, PlyValues& values, PlyMesh& mesh) {
  check_count(element, smallest_size(element, values), values);
  std::vector<int> corners;
  for (size_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      if (property.is_list &&
          is_any_of(property.name, {"vertex_indices", "vertex_index"})) {
        read_corners(property, values, corners);
        add_face(corners, mesh);
      } else {
        skip(property, values);
      }
    }
  }
}

void skip_element(const PlyElement& element, PlyValues& values) {
  check_count(element, smallest_size(element, values), values);
  if (element.properties.empty()) return;
  for (size_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) skip(property, values);
}

void check_indices(const PlyMesh& mesh) {
  const size_t count = mesh.positions.size();
  for (const Vec3i& t : mesh.triangles)
    for (const int index : {t.x, t.y, t.z})
      if (static_cast<size_t>(index) >= count)
        throw std::runtime_error(fmt::format(
            "a PLY face has the vertex index {}, but there are {} vertices", index, count));
}

}  // namespace

PlyMesh read_ply(std::string_view bytes, const Transform& placing) {
  const PlyHeader header = read_ply_header(bytes);
  PlyValues values(bytes.substr(header.size), header.format);
  PlyMesh mesh;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex")
      read_vertices(element, values, placing, mesh);
    else if (element.name == "face")
      read_faces(element, values, mesh);
    else
      skip_element(element, values);
  }
  if (mesh.triangles.empty()) throw std::runtime_error("the PLY file has no faces");
  check_indices(mesh);
  return mesh;
}

}  // namespace tyndall::loader
