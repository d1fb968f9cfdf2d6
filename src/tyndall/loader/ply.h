// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tyndall/math/transform.h"
#include "tyndall/math/vec.h"

namespace tyndall::loader {

/// The part of a PLY file that a mesh is made of.
struct PlyMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  ///< empty or one per position
  std::vector<Vec2> uvs;      ///< empty or one per position
  std::vector<Vec3i> triangles;
  bool has_skipped_faces = false;  ///< some faces had fewer than three corners
};

/// Reads a PLY file's bytes: ascii, or binary of either byte order; any scalar types; faces
/// of any number of corners, cut into triangles that share the first. Elements and
/// properties that it does not know are skipped. Throws std::runtime_error with the reason,
/// without the path: truncated, indices out of range, positions that are not finite, a
/// broken header. Positions are rounded after `placing` them, normals stay as they are.
PlyMesh read_ply(std::string_view bytes, const Transform& placing = {});

}  // namespace tyndall::loader
