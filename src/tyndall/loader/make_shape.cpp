// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/make_scene_parts.h"
#include "tyndall/loader/mesh_parts.h"
#include "tyndall/loader/ply.h"

namespace tyndall::loader {
namespace {

struct ShapeContext {
  ParameterSet& parameters;
  const Transform& world_from_object;
  bool reverse_orientation;
  const FileFinder& files;

  // pbrt-v4's rule for shapes without normals of their own.
  bool flips_normals() const {
    return reverse_orientation != world_from_object.swaps_handedness();
  }
};

// Per-vertex values must be as many as vertices; otherwise they are dropped.
template <typename T>
void check_per_vertex(ParameterSet& parameters, std::string_view name,
                      std::vector<T>& values, size_t vertex_count) {
  if (values.empty() || values.size() == vertex_count) return;
  parameters.error(
      name, fmt::format("\"{}\" must be given for each of the {} vertices, got {}", name,
                        vertex_count, values.size()));
  values.clear();
}

// The indices in groups of N; empty, with a report, if they are not usable.
template <size_t N>
std::vector<int> read_indices(ParameterSet& parameters, size_t vertex_count) {
  std::vector<int> indices = parameters.integers("indices");
  if (indices.empty() && vertex_count == N)
    for (size_t i = 0; i < N; ++i) indices.push_back(static_cast<int>(i));
  if (indices.empty())
    parameters.error("indices", "parameter \"integer indices\" is missing");
  if (indices.size() % N != 0) {
    parameters.error("indices", fmt::format("\"indices\" come in groups of {}, got {}", N,
                                            indices.size()));
    return {};
  }
  const auto bad = std::find_if(indices.begin(), indices.end(), [&](int i) {
    return i < 0 || static_cast<size_t>(i) >= vertex_count;
  });
  if (bad == indices.end()) return indices;
  parameters.error("indices", fmt::format("index {} is {}, but there are {} vertices",
                                          bad - indices.begin(), *bad, vertex_count));
  return {};
}

std::vector<Vec3> read_positions(ParameterSet& parameters) {
  std::vector<Vec3> positions = parameters.points3("P");
  if (positions.empty()) parameters.error("P", "parameter \"point3 P\" is missing");
  return positions;
}

std::optional<Shape> make_triangles(const ShapeContext& in) {
  ParameterSet& p = in.parameters;
  p.ignore({"S", "faceIndices"});
  MeshParts parts;
  parts.positions = read_positions(p);
  parts.normals = p.normals("N");
  parts.uvs = p.points2("uv");
  if (parts.positions.empty()) return std::nullopt;
  check_per_vertex(p, "N", parts.normals, parts.positions.size());
  check_per_vertex(p, "uv", parts.uvs, parts.positions.size());
  const std::vector<int> indices = read_indices<3>(p, parts.positions.size());
  if (indices.empty()) return std::nullopt;
  for (size_t i = 0; i < indices.size(); i += 3)
    parts.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  move_positions(parts.positions, in.world_from_object);
  return make_triangle_mesh(std::move(parts), in.world_from_object, in.reverse_orientation);
}

std::optional<Shape> make_bilinear(const ShapeContext& in) {
  ParameterSet& p = in.parameters;
  p.ignore({"faceIndices"});
  if (p.has("emissionfilename"))
    p.unsupported("emissionfilename",
                  "emission pictures are not supported yet, it is ignored");
  p.ignore({"emissionfilename"});
  std::vector<Vec3> positions = read_positions(p);
  std::vector<Vec3> normals = p.normals("N");
  std::vector<Vec2> uvs = p.points2("uv");
  if (positions.empty()) return std::nullopt;
  check_per_vertex(p, "N", normals, positions.size());
  check_per_vertex(p, "uv", uvs, positions.size());
  const std::vector<int> indices = read_indices<4>(p, positions.size());
  if (indices.empty()) return std::nullopt;
  std::vector<std::array<int, 4>> patches;
  for (size_t i = 0; i < indices.size(); i += 4)
    patches.push_back({indices[i], indices[i + 1], indices[i + 2], indices[i + 3]});
  move_positions(positions, in.world_from_object);
  move_normals(normals, in.world_from_object, in.reverse_orientation);
  return BilinearMesh(std::move(positions), std::move(patches), std::move(normals),
                      std::move(uvs), in.flips_normals());
}

std::optional<Shape> make_ply(const ShapeContext& in) {
  ParameterSet& p = in.parameters;
  if (p.has("displacement"))
    p.unsupported("displacement", "displacement is not supported yet, it is ignored");
  p.ignore({"displacement", "edgelength"});
  const std::string path =
      in.files.find(p.required_string("filename"), p.where("filename"));
  try {
    PlyMesh ply = read_ply(read_bytes(path), in.world_from_object);
    if (ply.has_skipped_faces)
      p.reporter().warning(
          p.where("filename"),
          fmt::format("\"{}\": faces with fewer than three corners are skipped", path));
    return make_triangle_mesh({std::move(ply.positions), std::move(ply.triangles),
                               std::move(ply.normals), std::move(ply.uvs)},
                              in.world_from_object, in.reverse_orientation);
  } catch (const std::runtime_error& error) {
    fail(p.where("filename"), fmt::format("cannot read \"{}\": {}", path, error.what()));
  }
}

constexpr Range full_turn{0, 360};

std::optional<Shape> make_sphere(const ShapeContext& in) {
  ParameterSet& p = in.parameters;
  const float radius = p.number("radius", 1, positive);
  const float z0 = p.number("zmin", -radius);
  const float z1 = p.number("zmax", radius);
  const float phi_max = p.number("phimax", 360, full_turn);
  return Sphere{in.world_from_object,
                radius,
                std::clamp(std::min(z0, z1), -radius, radius),
                std::clamp(std::max(z0, z1), -radius, radius),
                radians(phi_max),
                in.flips_normals()};
}

std::optional<Shape> make_disk(const ShapeContext& in) {
  ParameterSet& p = in.parameters;
  const float height = p.number("height", 0);
  const float radius = p.number("radius", 1, positive);
  const float inner_radius = p.number("innerradius", 0, {0, radius});
  const float phi_max = p.number("phimax", 360, full_turn);
  return Disk{in.world_from_object, height,           radius,
              inner_radius,         radians(phi_max), in.flips_normals()};
}

std::optional<Shape> not_yet(const ShapeContext& in) {
  in.parameters.ignore_all();
  in.parameters.reporter().unsupported(
      in.parameters.where(),
      fmt::format("{}: not supported yet, skipped", in.parameters.owner()));
  return std::nullopt;
}

struct ShapeType {
  std::string_view name;
  std::optional<Shape> (*make)(const ShapeContext&);
};

constexpr std::array shape_types{
    ShapeType{"trianglemesh", make_triangles},
    ShapeType{"plymesh", make_ply},
    ShapeType{"sphere", make_sphere},
    ShapeType{"disk", make_disk},
    ShapeType{"bilinearmesh", make_bilinear},
    ShapeType{"cylinder", not_yet},
    ShapeType{"curve", not_yet},
    ShapeType{"loopsubdiv", not_yet},
};

}  // namespace

std::optional<Shape> make_shape(const std::string& type, ParameterSet& parameters,
                                const Transform& world_from_object,
                                bool reverse_orientation, const FileFinder& files) {
  std::vector<std::string_view> names;
  for (const ShapeType& known : shape_types) {
    if (known.name == type)
      return known.make({parameters, world_from_object, reverse_orientation, files});
    names.push_back(known.name);
  }
  parameters.fail_unknown_type("shape", type, names);
}

}  // namespace tyndall::loader
