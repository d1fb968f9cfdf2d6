// SPDX-License-Identifier: Apache-2.0
#include "tests/geometry/test_shapes.h"

#include <cmath>

#include "tyndall/math/constants.h"

namespace tyndall {

TriangleMesh box_mesh(Vec3 center, Vec3 half, bool flip_normals) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(center + half * Vec3{i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f,
                                           i & 4 ? 1.0f : -1.0f});
  std::vector<Vec3i> triangles{{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                               {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                               {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return {corners, triangles, {}, {}, flip_normals};
}

TriangleMesh sphere_mesh(Vec3 center, float radius, int rows, int columns) {
  std::vector<Vec3> positions{center + Vec3{0, 0, radius}};
  for (int i = 1; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const float theta = pi * static_cast<float>(i) / static_cast<float>(rows);
      const float phi = 2 * pi * static_cast<float>(j) / static_cast<float>(columns);
      positions.push_back(center + spherical_direction(std::cos(theta), phi) * radius);
    }
  positions.push_back(center - Vec3{0, 0, radius});
  const int south = static_cast<int>(positions.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * columns + j % columns; };
  std::vector<Vec3i> triangles;
  for (int j = 0; j < columns; ++j) {
    triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i < rows - 1; ++i) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    triangles.push_back({at(rows - 1, j), south, at(rows - 1, j + 1)});
  }
  return {positions, triangles, {}, {}, false};
}

TriangleMesh transformed(const TriangleMesh& mesh, const Transform& to) {
  std::vector<Vec3> positions;
  for (const Vec3 p : mesh.positions()) positions.push_back(to.point(p));
  return {positions, mesh.triangles(), {}, {}, to.swaps_handedness()};
}

Vec3 random_direction(RandomStream& random) {
  const Vec2 u = random.next_2d();
  return normalize(spherical_direction(1 - 2 * u.x, 2 * pi * u.y));
}

Vec3 random_in_cube(RandomStream& random) {
  const float x = random.next_1d(), y = random.next_1d(), z = random.next_1d();
  return Vec3{x, y, z} * 2 - Vec3{1, 1, 1};
}

Transform random_transform(RandomStream& random, bool mirrored) {
  const Vec3 s = random_in_cube(random);
  const float mirror = mirrored ? -1.0f : 1.0f;
  return Transform::translate(random_in_cube(random) * 3) *
         Transform::rotate(360 * random.next_1d(), random_direction(random)) *
         Transform::scale({mirror * std::exp2(s.x), std::exp2(s.y), std::exp2(s.z)});
}

}  // namespace tyndall
