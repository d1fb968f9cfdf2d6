// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/geometry/bilinear_mesh.h"
#include "tyndall/geometry/rectangle.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/geometry/triangle_mesh.h"

namespace tyndall {

/// The rectangle that a shape is, or empty: one patch, or two triangles that share a
/// diagonal.
std::optional<Rectangle> as_rectangle(const BilinearMesh& mesh);
std::optional<Rectangle> as_rectangle(const TriangleMesh& mesh);

/// The point of the shape at fractions of the edges of as_rectangle(), which must not be
/// empty.
SurfacePoint point_of_rectangle(const BilinearMesh& mesh, Vec2 fractions);
SurfacePoint point_of_rectangle(const TriangleMesh& mesh, Vec2 fractions);

}  // namespace tyndall
