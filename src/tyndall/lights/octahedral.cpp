// SPDX-License-Identifier: Apache-2.0
#include "tyndall/lights/octahedral.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

// A cap of the sphere down to z has the area 2 pi (1 - z); the diamond |x| + |y| <= r has 2
// r^2 of the square's 4. So r^2 = 1 - z keeps areas, and going round the diamond at
// constant speed keeps them within the cap: the angle in the first quadrant is pi/2 times y
// / r. The lower hemisphere is the same, mirrored at the line |x| + |y| = 1, which keeps y
// - x.
Vec3 octahedral_direction(Vec2 p) {
  const float x = 2 * p.x - 1, y = 2 * p.y - 1;
  const float ax = magnitude(x), ay = magnitude(y);
  const bool upper = ax + ay <= 1;
  const float r = upper ? ax + ay : 2 - ax - ay;
  if (!(r > 0)) return {0, 0, upper ? 1.0f : -1.0f};
  const float phi = pi / 4 * ((ay - ax) / r + 1);
  const float z = 1 - sqr(r);
  const float sin_theta = r * safe_sqrt(2 - sqr(r));
  return {std::copysign(sin_theta * std::cos(phi), x),
          std::copysign(sin_theta * std::sin(phi), y), upper ? z : -z};
}

Vec2 octahedral_position(Vec3 w) {
  const float ax = magnitude(w.x), ay = magnitude(w.y), az = magnitude(w.z);
  const float r = std::min(std::sqrt((sqr(ax) + sqr(ay)) / (1 + az)), 1.0f);  // sqrt(1 - z)
  const float turn = r > 0 ? std::atan2(ay, ax) * (2 / pi) : 0;
  float y = r * turn;
  float x = r - y;
  if (w.z < 0) {
    const float mirrored = 1 - y;
    y = 1 - x;
    x = mirrored;
  }
  const auto to_unit = [](float a, float sign) {
    return std::clamp(0.5f * (std::copysign(a, sign) + 1), 0.0f, 1.0f);
  };
  return {to_unit(x, w.x), to_unit(y, w.y)};
}

}  // namespace tyndall
