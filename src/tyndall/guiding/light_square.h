// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/frame.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// What the uniform density on the square means on the sphere.
enum class SquareMeasure {
  /// The direction density of joint importance sampling in an isotropic medium,
  /// (pi - theta) / (pi^3 sin theta), theta from the direction to the light [Georgiev13].
  joint_sampling,
  solid_angle,  ///< 1 / (4 pi); for lights at infinity
};

/// A direction and the density there of the uniform density on the square.
struct SquareDirection {
  Vec3 w;         ///< unit
  float density;  ///< w.r.t. solid angle [1/sr]
};

/// The same, by the point of the square.
struct SquarePoint {
  Vec2 p;
  float density;  ///< w.r.t. solid angle [1/sr]
};

/// Maps the unit square onto all directions: its middle is the z axis of a frame (towards
/// the light), its edge the opposite direction. Shirley's concentric map [SC97] makes it a
/// disk whose squared radius is the cumulative distribution of theta, so a density f on the
/// square is the density f(p) * density w.r.t. solid angle.
///
/// Learning on this square starts, untrained, from exactly Georgiev's density, and
/// re-centring it on the light at each query point corrects the light's parallax.
class LightSquare {
 public:
  LightSquare(const Frame& frame, SquareMeasure measure)
      : frame_(frame), measure_(measure) {}

  SquareDirection direction(Vec2 p) const;
  /// The inverse of direction(); `w` is unit. With single-precision vectors its accuracy
  /// ends at about 1e-7 rad from the axis, where the density of joint sampling is held at a
  /// finite value.
  SquarePoint point(Vec3 w) const;
  /// Density of the uniform density alone [1/sr].
  float density(Vec3 w) const;

  const Frame& frame() const { return frame_; }
  SquareMeasure measure() const { return measure_; }

 private:
  Frame frame_;
  SquareMeasure measure_;
};

/// `reference` turned by the smallest rotation that takes its z axis to `axis` (unit).
/// Unlike Frame::from_z() continuous in `axis`, except at the direction opposite to the
/// reference.
Frame turned_frame(const Frame& reference, Vec3 axis);

}  // namespace tyndall
