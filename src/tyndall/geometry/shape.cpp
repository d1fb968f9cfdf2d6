// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/shape.h"

#include "tyndall/geometry/sample_by_area.h"

namespace tyndall {

SurfacePoint surface_point(const Shape& shape, uint32_t primitive, Vec2 uv) {
  return std::visit([&](const auto& s) { return s.point(primitive, uv); }, shape);
}

Bounds3 bounds(const Shape& shape) {
  return std::visit([](const auto& s) { return s.bounds(); }, shape);
}

float area(const Shape& shape) {
  return std::visit([](const auto& s) { return s.area(); }, shape);
}

ShapeSample sample_area(const Shape& shape, Vec2 u) {
  return std::visit([&](const auto& s) { return s.sample(u); }, shape);
}

std::optional<ShapeDirectionSample> sample_direction(const Shape& shape, Vec3 from,
                                                     Vec2 u) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.sample_direction(from, u); })
          return s.sample_direction(from, u);
        else
          return sample_direction_by_area(s, from, u);
      },
      shape);
}

float direction_pdf(const Shape& shape, Vec3 from, const SurfacePoint& on) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.direction_pdf(from, on); })
          return s.direction_pdf(from, on);
        else
          return direction_pdf_by_area(s, from, on);
      },
      shape);
}

}  // namespace tyndall
