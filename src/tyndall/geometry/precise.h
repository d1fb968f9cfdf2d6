// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/math/vec3d.h"

namespace tyndall {

/// The smallest box of floats that holds the box from `min` to `max`.
inline Bounds3 enclosing(Vec3d min, Vec3d max) {
  const auto below = [](double x) {
    const auto f = static_cast<float>(x);
    return static_cast<double>(f) > x ? std::nextafter(f, -infinity) : f;
  };
  return {.min = {below(min.x), below(min.y), below(min.z)},
          .max = {-below(-max.x), -below(-max.y), -below(-max.z)}};
}

/// The unit vector along `a`, or along z if `a` has no direction (zero or not finite).
inline Vec3d normalize_or_z(Vec3d a) {
  const double l = length(a);
  return l > 0 && std::isfinite(l) ? a * (1 / l) : Vec3d{0, 0, 1};
}

/// Two unit vectors that make a right-handed frame with the unit vector `z` [Duff17].
inline std::pair<Vec3d, Vec3d> perpendicular(Vec3d z) {
  const double sign = std::copysign(1.0, z.z);
  const double a = -1 / (sign + z.z);
  const double b = z.x * z.y * a;
  return {{1 + sign * z.x * z.x * a, sign * b, -sign * z.x},
          {b, sign + z.y * z.y * a, -z.y}};
}

/// An affine map: the upper three rows of a Transform, in double precision.
class Affine {
 public:
  /// Precondition: the transform is affine; its last row is ignored.
  explicit Affine(const Transform& t) {
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 4; ++j) m_[i][j] = t.matrix()[i][j];
  }

  /// The image of the j-th axis, or of the origin for j = 3.
  Vec3d column(size_t j) const { return {m_[0][j], m_[1][j], m_[2][j]}; }
  Vec3d point(Vec3d p) const { return vector(p) + column(3); }
  Vec3d vector(Vec3d v) const {
    return column(0) * v.x + column(1) * v.y + column(2) * v.z;
  }
  /// The transpose of the linear part applied to v.
  Vec3d transposed(Vec3d v) const {
    return {dot(column(0), v), dot(column(1), v), dot(column(2), v)};
  }

  double determinant() const { return dot(cross(column(0), column(1)), column(2)); }

  /// The normal of the image of a surface with unit normal `n`. Its length is the factor by
  /// which the surface's area grows.
  Vec3d normal(Vec3d n) const {
    // The cofactor matrix is the inverse transpose times the determinant.
    const Vec3d image = cross(column(1), column(2)) * n.x +
                        cross(column(2), column(0)) * n.y +
                        cross(column(0), column(1)) * n.z;
    return determinant() < 0 ? -image : image;
  }

  /// Not finite if the matrix is singular.
  Affine inverse() const {
    const double inv = 1 / determinant();
    const Vec3d rows[3] = {cross(column(1), column(2)) * inv,
                           cross(column(2), column(0)) * inv,
                           cross(column(0), column(1)) * inv};
    Affine result = *this;
    for (size_t i = 0; i < 3; ++i)
      result.m_[i] = {rows[i].x, rows[i].y, rows[i].z, -dot(rows[i], column(3))};
    return result;
  }

  /// Row by row.
  std::array<float, 12> floats() const {
    std::array<float, 12> values{};
    for (size_t i = 0; i < 12; ++i) values[i] = static_cast<float>(m_[i / 4][i % 4]);
    return values;
  }
  /// The map of floats().
  Affine rounded() const {
    Affine result = *this;
    for (auto& row : result.m_)
      for (double& x : row) x = static_cast<double>(static_cast<float>(x));
    return result;
  }

 private:
  std::array<std::array<double, 4>, 3> m_;
};

}  // namespace tyndall
