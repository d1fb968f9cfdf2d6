// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/mesh_parts.h"

#include <utility>

namespace tyndall::loader {
namespace {

// The side to which the normals point, or zero if there are none.
Vec3 stated_side(const MeshParts& parts, Vec3i t) {
  if (parts.normals.empty()) return {};
  const std::vector<Vec3>& n = parts.normals;
  return n[static_cast<size_t>(t.x)] + n[static_cast<size_t>(t.y)] +
         n[static_cast<size_t>(t.z)];
}

Vec3 winding_normal(const MeshParts& parts, Vec3i t) {
  const Vec3 a = parts.positions[static_cast<size_t>(t.x)];
  return cross(parts.positions[static_cast<size_t>(t.y)] - a,
               parts.positions[static_cast<size_t>(t.z)] - a);
}

void move_to_world(MeshParts& parts, const Transform& world_from_object, bool reverse) {
  for (Vec3& p : parts.positions) p = world_from_object.point(p);
  for (Vec3& n : parts.normals) {
    n = world_from_object.normal(n);
    const float size = length(n);
    if (size > 0) n = n / (reverse ? -size : size);
  }
}

}  // namespace

TriangleMesh make_triangle_mesh(MeshParts parts, const Transform& world_from_object,
                                bool reverse_orientation) {
  move_to_world(parts, world_from_object, reverse_orientation);
  const bool flips_winding = reverse_orientation != world_from_object.swaps_handedness();
  for (Vec3i& t : parts.triangles) {
    const float agreement = dot(winding_normal(parts, t), stated_side(parts, t));
    if (agreement < 0 || (agreement == 0 && flips_winding)) std::swap(t.y, t.z);
  }
  // The windings now say all.
  return {std::move(parts.positions), std::move(parts.triangles), std::move(parts.normals),
          std::move(parts.uvs), false};
}

}  // namespace tyndall::loader
