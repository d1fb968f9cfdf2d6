// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/surface_point.h"
#include "tyndall/sampling/measure.h"

namespace tyndall {

/// Density of the direction from `from` to a point `on` that a shape's sample() draws
/// [1/sr]; zero where the surface is seen edge-on or from no distance.
template <typename S>
float direction_pdf_by_area(const S& shape, Vec3 from, const SurfacePoint& on) {
  const Vec3d to_viewer = Vec3d(from) - Vec3d(on.p);
  const double distance2 = dot(to_viewer, to_viewer);
  const double cos = std::abs(dot(Vec3d(on.ng), to_viewer)) / std::sqrt(distance2);
  const float pdf = solid_angle_from_area(shape.pdf_area(on), static_cast<float>(distance2),
                                          static_cast<float>(cos));
  return std::isfinite(pdf) ? pdf : 0;
}

/// A point of sample() by its direction. Empty where direction_pdf_by_area() is zero.
template <typename S>
std::optional<ShapeDirectionSample> sample_direction_by_area(const S& shape, Vec3 from,
                                                             Vec2 u) {
  const SurfacePoint on = shape.sample(u).point;
  const float pdf = direction_pdf_by_area(shape, from, on);
  if (!(pdf > 0)) return std::nullopt;
  return ShapeDirectionSample{.point = on, .pdf = pdf};
}

}  // namespace tyndall
