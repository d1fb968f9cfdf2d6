// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/grid_space.h"

#include <algorithm>

namespace tyndall {

GridSpace::GridSpace(const Transform& grid_from_world) {
  for (size_t i = 0; i < 3; ++i) m_[i] = grid_from_world.matrix()[i];
}

GridSpace GridSpace::moved(Vec3d by) const {
  GridSpace result = *this;
  for (std::array<double, 4>& m : result.m_)
    m[3] -= m[0] * by.x + m[1] * by.y + m[2] * by.z;
  return result;
}

std::optional<GridSpace::Clip> GridSpace::clip(const Ray& ray, float t_max,
                                               const Bounds3& box) const {
  if (box.is_empty()) return std::nullopt;
  double t0 = 0, t1 = double{t_max};
  std::array<double, 3> o{}, d{};
  for (int axis = 0; axis < 3; ++axis) {
    const size_t i = static_cast<size_t>(axis);
    const std::array<double, 4>& m = m_[i];
    o[i] = m[0] * double{ray.o.x} + m[1] * double{ray.o.y} + m[2] * double{ray.o.z} + m[3];
    d[i] = m[0] * double{ray.d.x} + m[1] * double{ray.d.y} + m[2] * double{ray.d.z};
    const double min = double{box.min[axis]}, max = double{box.max[axis]};
    if (d[i] == 0) {
      if (o[i] < min || o[i] > max) return std::nullopt;
      continue;
    }
    const double a = (min - o[i]) / d[i], b = (max - o[i]) / d[i];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  const float t_min = static_cast<float>(t0);
  const float length = static_cast<float>(t1 - double{t_min});
  if (!(length > 0)) return std::nullopt;
  const auto at = [&](size_t i) { return static_cast<float>(o[i] + double{t_min} * d[i]); };
  const auto direction = [&](size_t i) { return static_cast<float>(d[i]); };
  return Clip{.ray = {{at(0), at(1), at(2)}, {direction(0), direction(1), direction(2)}},
              .t_offset = t_min,
              .length = length};
}

}  // namespace tyndall
