// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/mesh_parts.h"

#include <utility>

namespace tyndall::loader {

void move_positions(std::vector<Vec3>& positions, const Transform& world_from_object) {
  for (Vec3& p : positions) p = world_from_object.point(p);
}

void move_normals(std::vector<Vec3>& normals, const Transform& world_from_object,
                  bool reverse_orientation) {
  for (Vec3& n : normals) n = world_from_object.normal(reverse_orientation ? -n : n);
}

TriangleMesh make_triangle_mesh(MeshParts parts, const Transform& world_from_object,
                                bool reverse_orientation) {
  move_normals(parts.normals, world_from_object, reverse_orientation);
  return {std::move(parts.positions), std::move(parts.triangles), std::move(parts.normals),
          std::move(parts.uvs),
          reverse_orientation != world_from_object.swaps_handedness()};
}

}  // namespace tyndall::loader
