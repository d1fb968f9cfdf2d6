// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/triangle_mesh.h"

#include <utility>

namespace tyndall {
namespace {

// pbrt's texture coordinates of a triangle that brings none.
constexpr Vec2 default_uvs[3] = {{0, 0}, {1, 0}, {1, 1}};

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Vec3> positions, std::vector<Vec3i> triangles,
                           std::vector<Vec3> normals, std::vector<Vec2> uvs,
                           bool flip_normals)
    : positions_(std::move(positions)),
      triangles_(std::move(triangles)),
      normals_(std::move(normals)),
      uvs_(std::move(uvs)),
      flip_normals_(flip_normals) {
  areas_.reserve(triangles_.size());
  for (uint32_t i = 0; i < triangles_.size(); ++i)
    areas_.append(0.5 * length(unnormalized_normal(i)));
}

Vec3d TriangleMesh::corner(uint32_t primitive, int i) const {
  const Vec3i& t = triangles_[primitive];
  return Vec3d(positions_[static_cast<size_t>(i == 0 ? t.x : i == 1 ? t.y : t.z)]);
}

Vec3d TriangleMesh::unnormalized_normal(uint32_t primitive) const {
  const Vec3d p0 = corner(primitive, 0);
  return cross(corner(primitive, 1) - p0, corner(primitive, 2) - p0);
}

Vec3d TriangleMesh::position(uint32_t primitive, Vec2 barycentric) const {
  const Vec3d p0 = corner(primitive, 0);
  return p0 + (corner(primitive, 1) - p0) * static_cast<double>(barycentric.x) +
         (corner(primitive, 2) - p0) * static_cast<double>(barycentric.y);
}

SurfacePoint TriangleMesh::point(uint32_t primitive, Vec2 barycentric) const {
  const Vec3i& t = triangles_[primitive];
  const size_t index[3] = {static_cast<size_t>(t.x), static_cast<size_t>(t.y),
                           static_cast<size_t>(t.z)};
  const float b[3] = {1 - barycentric.x - barycentric.y, barycentric.x, barycentric.y};
  Vec3 ng = to_float(normalize_or_z(unnormalized_normal(primitive)));
  Vec3 ns = flip_normals_ ? -ng : ng;
  if (!normals_.empty()) {
    const Vec3 n =
        normals_[index[0]] * b[0] + normals_[index[1]] * b[1] + normals_[index[2]] * b[2];
    if (length_squared(n) > 0) ns = normalize(n);
  }
  if (dot(ng, ns) < 0) ng = -ng;
  Vec2 uv;
  for (size_t i = 0; i < 3; ++i)
    uv = uv + (uvs_.empty() ? default_uvs[i] : uvs_[index[i]]) * b[i];
  return {.p = to_float(position(primitive, barycentric)), .ng = ng, .ns = ns, .uv = uv};
}

Bounds3 TriangleMesh::bounds() const {
  Bounds3 b;
  for (const Vec3i& t : triangles_)
    for (const int i : {t.x, t.y, t.z}) {
      const Vec3 p = positions_[static_cast<size_t>(i)];
      if (is_finite(p)) b.extend(p);
    }
  return b;
}

ShapeSample TriangleMesh::sample(Vec2 u) const {
  if (!(areas_.total() > 0)) return {.point = {}, .pdf_area = 0};
  const PrimitiveChoice choice = areas_.choose(u.x);
  // Lines of constant b0 are as long as 1 - b0, so that 1 - b0 has the density 2 (1 - b0).
  const float root = std::sqrt(choice.u_remapped);
  const Vec2 barycentric{root * (1 - u.y), root * u.y};
  const SurfacePoint on = point(choice.primitive, barycentric);
  return {.point = on, .pdf_area = pdf_area(on)};
}

float TriangleMesh::pdf_area(const SurfacePoint&) const {
  return areas_.total() > 0 ? static_cast<float>(1 / areas_.total()) : 0;
}

}  // namespace tyndall
