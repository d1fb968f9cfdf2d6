// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/rectangle_light.h"

#include <array>
#include <cmath>

namespace tyndall {
namespace {

// Two triangles as a rectangle: which corner of the first is where its edges start, and
// which of the second is across the diagonal.
struct Halves {
  Rectangle rectangle;
  size_t first_corner, last_corner;
};

std::array<Vec3, 3> corners(const TriangleMesh& mesh, size_t triangle) {
  const Vec3i& t = mesh.triangles()[triangle];
  const std::vector<Vec3>& p = mesh.positions();
  return {p[static_cast<size_t>(t.x)], p[static_cast<size_t>(t.y)],
          p[static_cast<size_t>(t.z)]};
}

std::optional<Halves> halves_of(const TriangleMesh& mesh) {
  if (mesh.triangles().size() != 2) return std::nullopt;
  const std::array<Vec3, 3> a = corners(mesh, 0), b = corners(mesh, 1);
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      // The diagonal runs the other way in the second triangle.
      if (a[(i + 1) % 3] != b[(j + 2) % 3] || a[(i + 2) % 3] != b[(j + 1) % 3]) continue;
      const Vec3d origin(a[i]);
      const Rectangle rectangle{.corner = origin,
                                .edge_x = Vec3d(a[(i + 1) % 3]) - origin,
                                .edge_y = Vec3d(a[(i + 2) % 3]) - origin};
      const Vec3d gap = origin + rectangle.edge_x + rectangle.edge_y - Vec3d(b[j]);
      const double size = length(rectangle.edge_x) + length(rectangle.edge_y);
      if (rectangle.is_proper() && length(gap) <= 1e-5 * size)
        return Halves{rectangle, i, j};
    }
  return std::nullopt;
}

SurfacePoint point_of_triangle(const TriangleMesh& mesh, uint32_t triangle, size_t first,
                               const std::array<float, 3>& weights) {
  const Vec2 barycentric{weights[(4 - first) % 3], weights[(5 - first) % 3]};
  return mesh.point(triangle, barycentric);
}

}  // namespace

std::optional<Rectangle> as_rectangle(const BilinearMesh& mesh) {
  if (mesh.patches().size() != 1) return std::nullopt;
  const BilinearPatch patch = mesh.patch(0);
  const Rectangle rectangle{.corner = patch.p00,
                            .edge_x = patch.p10 - patch.p00,
                            .edge_y = patch.p01 - patch.p00};
  if (!patch.is_parallelogram() || !rectangle.is_proper()) return std::nullopt;
  return rectangle;
}

std::optional<Rectangle> as_rectangle(const TriangleMesh& mesh) {
  const std::optional<Halves> halves = halves_of(mesh);
  if (!halves) return std::nullopt;
  return halves->rectangle;
}

SurfacePoint point_of_rectangle(const BilinearMesh& mesh, Vec2 fractions) {
  return mesh.point(0, fractions);
}

SurfacePoint point_of_rectangle(const TriangleMesh& mesh, Vec2 fractions) {
  const std::optional<Halves> halves = halves_of(mesh);
  const auto [x, y] = fractions;
  if (x + y <= 1)
    return point_of_triangle(mesh, 0, halves->first_corner, {1 - x - y, x, y});
  return point_of_triangle(mesh, 1, halves->last_corner, {x + y - 1, 1 - x, 1 - y});
}

}  // namespace tyndall
