// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/geometry/precise.h"

namespace tyndall {

/// A rectangle by a corner and the edges from there.
struct Rectangle {
  Vec3d corner, edge_x, edge_y;

  /// Whether the edges are at right angles, up to the rounding of float corners, and not
  /// zero.
  bool is_proper() const;
};

/// A rectangle as seen from a point: the sphere around the point shows it as a
/// quadrilateral of great circles, over which directions are uniform [Urena13].
class SphericalRectangle {
 public:
  /// Empty where sampling by area does better: far away, where the solid angle is lost in
  /// rounding and the two are alike, and in the plane of the rectangle.
  static std::optional<SphericalRectangle> seen_from(Vec3 from, const Rectangle& rectangle);

  double solid_angle() const { return solid_angle_; }  ///< [sr]
  /// The point as fractions of the edges, uniform in solid angle.
  Vec2 sample(Vec2 u) const;

 private:
  SphericalRectangle() = default;

  // The rectangle in its own frame around the viewer: [x0, x1] x [y0, y1] in the plane z <
  // 0.
  double x0_, x1_, y0_, y1_, z_;
  double solid_angle_;
  double far_angles_;  // 2 pi minus the inner angles at the corners with x = x0
};

}  // namespace tyndall
