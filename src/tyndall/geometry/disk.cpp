// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/disk.h"

#include <algorithm>
#include <cmath>

#include "tyndall/geometry/azimuth.h"

namespace tyndall {
namespace {

double area_in_disk_space(const Disk& disk) {
  const auto outer = static_cast<double>(disk.radius);
  const auto inner = static_cast<double>(disk.inner_radius);
  return std::max(0.5 * azimuth_range(disk.phi_max) * (outer - inner) * (outer + inner),
                  0.0);
}

}  // namespace

SurfacePoint Disk::point(uint32_t, Vec2 uv) const {
  const double phi = static_cast<double>(uv.x) * azimuth_range(phi_max);
  const double r = std::lerp(static_cast<double>(radius), static_cast<double>(inner_radius),
                             static_cast<double>(uv.y));
  const Affine world(world_from_disk);
  const Vec3d p =
      world.point({r * std::cos(phi), r * std::sin(phi), static_cast<double>(height)});
  const Vec3d n = normalize_or_z(world.normal({0, 0, 1}));
  const Vec3 ng = to_float(flip_normals ? -n : n);
  return {.p = to_float(p), .ng = ng, .ns = ng, .uv = uv};
}

Bounds3 Disk::bounds() const {
  if (!(area_in_disk_space(*this) > 0)) return {};
  // A circle reaches as far along an axis as the ellipse that it is mapped to: its radius
  // times the length of that row of the map.
  const Affine world(world_from_disk);
  const Vec3d center = world.point({0, 0, static_cast<double>(height)});
  const Vec3d x = world.column(0), y = world.column(1);
  const Vec3d reach =
      Vec3d{std::hypot(x.x, y.x), std::hypot(x.y, y.y), std::hypot(x.z, y.z)} *
      static_cast<double>(radius);
  return enclosing(center - reach, center + reach);
}

float Disk::area() const {
  return static_cast<float>(area_in_disk_space(*this) *
                            length(Affine(world_from_disk).normal({0, 0, 1})));
}

ShapeSample Disk::sample(Vec2 u) const {
  // Uniform by area is uniform in the squared radius.
  const float r2 = std::lerp(radius * radius, inner_radius * inner_radius, u.y);
  const float v =
      radius > inner_radius ? (radius - std::sqrt(r2)) / (radius - inner_radius) : 0;
  const SurfacePoint on = point(0, {u.x, v});
  return {.point = on, .pdf_area = pdf_area(on)};
}

float Disk::pdf_area(const SurfacePoint&) const {
  const float a = area();
  return a > 0 ? 1 / a : 0;
}

}  // namespace tyndall
