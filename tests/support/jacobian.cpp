// SPDX-License-Identifier: Apache-2.0
#include "support/jacobian.h"

#include <cmath>

namespace tyndall {
namespace {

constexpr float step = 0x1p-9f;

}  // namespace

double surface_jacobian(const std::function<Vec3(Vec2)>& map, Vec2 u) {
  const Vec3 dx = (map({u.x + step, u.y}) - map({u.x - step, u.y})) / (2 * step);
  const Vec3 dy = (map({u.x, u.y + step}) - map({u.x, u.y - step})) / (2 * step);
  return double{length(cross(dx, dy))};
}

double line_jacobian(const std::function<float(float)>& map, float u) {
  return std::abs(double{map(u + step)} - double{map(u - step)}) / (2 * double{step});
}

}  // namespace tyndall
