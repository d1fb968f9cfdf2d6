// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tyndall/geometry/shape.h"
#include "tyndall/math/transform.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// A closed box around `center` with half edges `half`, of 12 triangles that face outward.
TriangleMesh box_mesh(Vec3 center, Vec3 half, bool flip_normals = false);

/// A closed mesh of a sphere with `rows` rows and `columns` columns of quads, facing
/// outward.
TriangleMesh sphere_mesh(Vec3 center, float radius, int rows, int columns);

/// A mesh moved by a transform, its outside kept on the same side.
TriangleMesh transformed(const TriangleMesh& mesh, const Transform& to);

/// Uniform on the unit sphere.
Vec3 random_direction(RandomStream& random);
/// Uniform in the cube [-1, 1]^3.
Vec3 random_in_cube(RandomStream& random);
/// A rotation about a random axis, a scale with factors in [1/2, 2], and a translation.
Transform random_transform(RandomStream& random, bool mirrored = false);

}  // namespace tyndall
