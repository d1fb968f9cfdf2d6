// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/shape.h"

#include <type_traits>

#include "tyndall/geometry/rectangle_light.h"
#include "tyndall/geometry/sample_by_area.h"

namespace tyndall {
namespace {

template <typename S>
constexpr bool may_be_rectangle =
    std::is_same_v<S, TriangleMesh> || std::is_same_v<S, BilinearMesh>;

// The shape as a rectangle that is best sampled by solid angle from there, or empty.
template <typename S>
std::optional<SphericalRectangle> spherical_rectangle(const S& shape, Vec3 from) {
  if constexpr (may_be_rectangle<S>)
    if (const std::optional<Rectangle> rectangle = as_rectangle(shape))
      return SphericalRectangle::seen_from(from, *rectangle);
  return std::nullopt;
}

template <typename S>
std::optional<ShapeDirectionSample> sample_direction_to(const S& shape, Vec3 from, Vec2 u) {
  if constexpr (may_be_rectangle<S>)
    if (const auto seen = spherical_rectangle(shape, from))
      return ShapeDirectionSample{.point = point_of_rectangle(shape, seen->sample(u)),
                                  .pdf = static_cast<float>(1 / seen->solid_angle())};
  return sample_direction_by_area(shape, from, u);
}

template <typename S>
float direction_pdf_of(const S& shape, Vec3 from, const SurfacePoint& on) {
  if (const auto seen = spherical_rectangle(shape, from))
    return static_cast<float>(1 / seen->solid_angle());
  return direction_pdf_by_area(shape, from, on);
}

}  // namespace

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
          return sample_direction_to(s, from, u);
      },
      shape);
}

float direction_pdf(const Shape& shape, Vec3 from, const SurfacePoint& on) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.direction_pdf(from, on); })
          return s.direction_pdf(from, on);
        else
          return direction_pdf_of(s, from, on);
      },
      shape);
}

}  // namespace tyndall
