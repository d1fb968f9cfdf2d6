// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/math/transform.h"
#include "tyndall/math/vec.h"

namespace tyndall::loader {

/// A triangle mesh on its way from a file.
struct MeshParts {
  std::vector<Vec3> positions;  ///< in world space already, where doubles came in
  std::vector<Vec3i> triangles;
  std::vector<Vec3> normals;  ///< in object space; empty or one per position
  std::vector<Vec2> uvs;      ///< empty or one per position
};

/// From object to world space; `reverse_orientation` negates the normals.
void move_positions(std::vector<Vec3>& positions, const Transform& world_from_object);
void move_normals(std::vector<Vec3>& normals, const Transform& world_from_object,
                  bool reverse_orientation);

/// The mesh in world space. As in pbrt-v4, a triangle with normals faces where they do, one
/// without faces where its winding says; `reverse_orientation` turns both around.
TriangleMesh make_triangle_mesh(MeshParts parts, const Transform& world_from_object,
                                bool reverse_orientation);

}  // namespace tyndall::loader
