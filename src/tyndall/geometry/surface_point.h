// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/vec.h"

namespace tyndall {

/// A point on a shape with what shading needs to know of it.
struct SurfacePoint {
  Vec3 p;   ///< world space
  Vec3 ng;  ///< unit geometric normal; its side is the shape's outside
  Vec3 ns;  ///< unit shading normal, in the hemisphere of ng
  Vec2 uv;  ///< texture coordinates
};

/// A point drawn on a shape.
struct ShapeSample {
  SurfacePoint point;
  float
      pdf_area;  ///< density w.r.t. surface area [1/scene unit^2]; zero if there is no area
};

/// A point drawn on a shape as seen from elsewhere.
struct ShapeDirectionSample {
  SurfacePoint point;  ///< without `uv`
  float pdf;  ///< density of the direction towards it w.r.t. solid angle [1/sr]; finite
};

}  // namespace tyndall
