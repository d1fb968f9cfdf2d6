// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/elementary.h"
#include "tyndall/math/scalar.h"

namespace tyndall {

/// The stretch [t_min, t_max] of a ray as seen from a pivot, usually a point on a light:
/// the coordinates that all distance techniques share. t_max may be infinite.
///
/// Positions are measured by their offset from that end of the stretch that is nearer to
/// the foot of the perpendicular from the pivot, so that no difference of nearly equal
/// numbers is ever taken: a stretch far from the pivot, or a pivot on the line of the ray,
/// loses no digits. `s` is the position relative to the foot, counted in the direction away
/// from that end; it grows with the offset, from s_near() on.
class PivotSegment {
 public:
  PivotSegment(const Ray& ray, Vec3 pivot, float t_min, float t_max)
      : t_min_(t_min), t_max_(t_max) {
    // In double: the cross product cancels for a pivot near the ray, and squares overflow.
    const double x = double(pivot.x) - ray.o.x, y = double(pivot.y) - ray.o.y,
                 z = double(pivot.z) - ray.o.z;
    const double dx = ray.d.x, dy = ray.d.y, dz = ray.d.z;
    const double foot = x * dx + y * dy + z * dz;
    const double cx = y * dz - z * dy, cy = z * dx - x * dz, cz = x * dy - y * dx;
    const double h2 = cx * cx + cy * cy + cz * cz;
    const double s_min = t_min - foot, s_max = t_max - foot;
    sign_ = std::copysign(1.0f, static_cast<float>(s_min + s_max));
    const double s = std::max(s_min, -s_max);
    const double r = std::sqrt(h2 + s * s);
    h_ = static_cast<float>(std::sqrt(h2));
    s_near_ = static_cast<float>(s);
    r_near_ = static_cast<float>(r);
    t_near_ = by_sign(sign_, t_min, t_max);
    length_ = t_max - t_min;
  }

  /// False if the stretch is empty, not a number, or runs through the pivot, where
  /// densities in the inverse distance have no finite integral.
  bool is_proper() const {
    return length_ > 0 && t_min_ > -infinity && r_near_ > 0 && r_near_ < infinity &&
           h_ < infinity && (h_ > 0 || s_near_ > 0);
  }

  float h() const { return h_; }            ///< distance of the pivot from the line
  float s_near() const { return s_near_; }  ///< of the near end
  float r_near() const { return r_near_; }  ///< distance of the pivot from the near end
  float length() const { return length_; }  ///< largest offset, may be infinite
  float t_min() const { return t_min_; }
  float t_max() const { return t_max_; }
  /// The near end is t_min, and offsets grow with t. Else it is t_max, and they fall.
  bool is_forward() const { return sign_ > 0; }
  float sign() const { return sign_; }  ///< 1 if offsets grow with t, else -1
  float t_near() const { return t_near_; }

  /// r + s and r - s of a point, not cancelled. Their product is h^2.
  float plus(float s, float r) const {
    const float sum = r + magnitude(s);
    return by_sign(s, sum, h_ * (h_ / sum));
  }
  float minus(float s, float r) const { return plus(-s, r); }

  bool contains(float t) const { return t >= t_min_ && t <= t_max_; }
  float offset(float t) const { return sign_ * (t - t_near_); }
  /// The t of an offset, within the stretch and finite.
  float t(float offset) const {
    return std::min(std::clamp(t_near_ + sign_ * offset, t_min_, t_max_),
                    std::numeric_limits<float>::max());
  }
  float s(float offset) const { return s_near_ + offset; }
  float r(float s) const { return std::sqrt(h_ * h_ + s * s); }

  /// A uniform number counted from the near end, and back.
  float from_near(float u) const { return by_sign(sign_, u, 1 - u); }

 private:
  float t_min_, t_max_, t_near_, length_, sign_;
  float h_, s_near_, r_near_;
};

}  // namespace tyndall
