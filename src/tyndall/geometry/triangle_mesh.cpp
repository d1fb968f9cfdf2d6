// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/triangle_mesh.h"

#include <utility>

namespace tyndall {
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
    areas_.append(0.5 * length(triangle(i).normal()));
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
