// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "tyndall/math/bounds.h"
#include "tyndall/math/vec.h"
#include "tyndall/math/vec3d.h"

namespace tyndall {

using Matrix4 = std::array<std::array<double, 4>, 4>;  ///< rows of a column-vector matrix

/// An affine or projective map together with its inverse.
///
/// Named a_from_b: `world_from_medium.point(p_medium)` is a point in world space, and
/// chains read right to left: world_from_medium * medium_from_grid. Double precision, so
/// that large translations in a chain cancel; results are rounded once.
class Transform {
 public:
  Transform();  ///< identity

  /// Empty if the matrix is singular, or it or its inverse does not fit in floats.
  static std::optional<Transform> from_matrix(const Matrix4& m);
  static Transform translate(Vec3d by);
  /// Precondition: no component is zero.
  static Transform scale(Vec3d by);
  /// Turns by `angle` [degrees] about `axis`, which need not be unit but not zero.
  static Transform rotate(double angle, Vec3d axis);
  /// camera_from_world: the camera at `eye` sees `at` along +z, `up` along +y (left-handed,
  /// as in pbrt). Empty if the three do not span a frame.
  static std::optional<Transform> look_at(Vec3d eye, Vec3d at, Vec3d up);

  Vec3 point(Vec3 p) const { return to_float(precise_point(p)); }  ///< divides by w
  Vec3d precise_point(Vec3d p) const;  ///< the same, not rounded
  Vec3 vector(Vec3 v) const;           ///< ignores translation; keeps length only if rigid
  Vec3 normal(Vec3 n) const;           ///< inverse transpose; not normalised
  Bounds3 bounds(const Bounds3& b) const;

  Transform inverse() const;
  Transform operator*(const Transform& b) const;

  /// Whether the numbers of both matrices are finite as floats, too.
  bool fits_in_floats() const;
  bool swaps_handedness() const;  ///< determinant of the 3x3 part is negative
  const Matrix4& matrix() const { return m_; }
  const Matrix4& inverse_matrix() const { return inv_; }

  friend bool operator==(const Transform&, const Transform&) = default;

 private:
  Transform(const Matrix4& m, const Matrix4& inv) : m_(m), inv_(inv) {}

  Matrix4 m_, inv_;
};

}  // namespace tyndall
