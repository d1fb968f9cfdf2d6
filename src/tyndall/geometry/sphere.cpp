// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tyndall/geometry/azimuth.h"
#include "tyndall/geometry/sample_by_area.h"
#include "tyndall/math/constants.h"

namespace tyndall {
namespace {

struct Range {
  double min, max;
};

// The clips as heights in sphere space.
Range z_range(const Sphere& s) {
  const double r = std::max(static_cast<double>(s.radius), 0.0);
  const double a = std::clamp(static_cast<double>(s.z_min), -r, r);
  const double b = std::clamp(static_cast<double>(s.z_max), -r, r);
  return {std::min(a, b), std::max(a, b)};
}

double area_in_sphere_space(const Sphere& s) {
  const Range z = z_range(s);
  return std::max(
      azimuth_range(s.phi_max) * static_cast<double>(s.radius) * (z.max - z.min), 0.0);
}

Vec3d direction(double cos_theta, double phi) {
  const double sin_theta = std::sqrt(std::max(1 - cos_theta * cos_theta, 0.0));
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

// Whether the map takes spheres to spheres, up to the rounding of a product of float
// matrices.
bool keeps_spheres(const Affine& m) {
  constexpr double tolerance = 4e-6;
  const Vec3d x = m.column(0), y = m.column(1), z = m.column(2);
  const double xx = dot(x, x), limit = tolerance * xx;
  return std::abs(dot(y, y) - xx) <= limit && std::abs(dot(z, z) - xx) <= limit &&
         std::abs(dot(x, y)) <= limit && std::abs(dot(y, z)) <= limit &&
         std::abs(dot(z, x)) <= limit;
}

// The cone that a whole sphere fills as seen from outside.
struct Cone {
  Vec3d axis;            // unit, towards the center
  double one_minus_cos;  // of its half angle, exact also if the sphere is small and far
  double distance;       // to the center
  double radius;         // of the sphere, in world space
};

std::optional<Cone> cone_from_outside(const Sphere& s, const Affine& world, Vec3 from) {
  if (!s.is_full() || !keeps_spheres(world)) return std::nullopt;
  const Vec3d to_center = world.column(3) - Vec3d(from);
  const double d = length(to_center);
  const double r = static_cast<double>(s.radius) * length(world.column(0));
  // Closer than this the cone is a half space, and its density useless.
  if (!(r > 0) || !(d > r * (1 + 1e-6)) || !std::isfinite(d)) return std::nullopt;
  const double sin2 = (r / d) * (r / d);
  const double cos = std::sqrt((d - r) * (d + r)) / d;
  return Cone{.axis = to_center * (1 / d),
              .one_minus_cos = sin2 / (1 + cos),
              .distance = d,
              .radius = r};
}

// The normal of the sphere's near side at the angle from the cone's axis that u.x gives.
//
// With s = sin(theta) and s_m = sin(theta_max) the near point of the sphere lies at the
// distance d (cos(theta) - sqrt(s_m^2 - s^2)); its offset from the center, divided by the
// radius d s_m, is the sum of the two parts below. The difference of the squares is
// factored because both are tiny for a far sphere.
Vec3d near_side_normal(const Cone& cone, Vec2 u) {
  const double x_max = cone.one_minus_cos;
  const double x = static_cast<double>(u.x) * x_max;  // 1 - cos(theta)
  const double s = std::sqrt(x * (2 - x));
  const double s_max = cone.radius / cone.distance;
  const double root = std::sqrt(std::max((x_max - x) * (2 - x_max - x), 0.0));
  const double along = (s * s + (1 - x) * root) / s_max;
  const double across = (1 - x - root) * s / s_max;
  const double phi = full_turn * static_cast<double>(u.y);
  const auto [b, c] = perpendicular(cone.axis);
  return b * (across * std::cos(phi)) + c * (across * std::sin(phi)) - cone.axis * along;
}

// A whole sphere as seen from inside.
struct Shell {
  Vec3d viewer;   // from the center
  double radius;  // in world space
};

std::optional<Shell> shell_from_inside(const Sphere& s, const Affine& world, Vec3 from) {
  if (!s.is_full() || !keeps_spheres(world)) return std::nullopt;
  const Vec3d viewer = Vec3d(from) - world.column(3);
  const double r = static_cast<double>(s.radius) * length(world.column(0));
  // Closer to the surface than this, rounding decides which side it is.
  if (!(length(viewer) < r * (1 - 1e-6)) || !std::isfinite(r)) return std::nullopt;
  return Shell{viewer, r};
}

// The sphere's normal where a direction uniform about the viewer meets it.
Vec3d far_side_normal(const Shell& shell, Vec2 u) {
  const Vec3d w =
      direction(1 - 2 * static_cast<double>(u.x), full_turn * static_cast<double>(u.y));
  const double b = dot(shell.viewer, w);
  const double c = dot(shell.viewer, shell.viewer) - shell.radius * shell.radius;
  const double t = std::sqrt(b * b - c) - b;
  return (shell.viewer + w * t) * (1 / shell.radius);
}

float cone_pdf(const Cone& cone) {
  const auto pdf = static_cast<float>(1 / (full_turn * cone.one_minus_cos));
  return std::isfinite(pdf) ? pdf : 0;
}

}  // namespace

bool Sphere::is_full() const {
  const Range z = z_range(*this);
  const auto r = static_cast<double>(radius);
  return z.min <= -r && z.max >= r && azimuth_range(phi_max) == full_turn;
}

SurfacePoint Sphere::point_at(Vec3d n) const {
  const Affine world(world_from_sphere);
  const Vec3d normal = normalize_or_z(world.normal(n));
  const Vec3 ng = to_float(flip_normals ? -normal : normal);
  return {.p = to_float(world.point(n * static_cast<double>(radius))),
          .ng = ng,
          .ns = ng,
          .uv = parameters(n)};
}

Vec2 Sphere::parameters(Vec3d n) const {
  const Range z = z_range(*this);
  const auto r = static_cast<double>(radius);
  const double phi = azimuth(n.x, n.y);
  const double theta_min = z.min > -r ? std::acos(z.min / r) : std::numbers::pi;
  const double theta_max = z.max < r ? std::acos(z.max / r) : 0;
  const double theta = std::acos(std::clamp(n.z, -1.0, 1.0));
  return {static_cast<float>(phi / azimuth_range(phi_max)),
          static_cast<float>((theta - theta_min) / (theta_max - theta_min))};
}

SurfacePoint Sphere::point(uint32_t, Vec2 uv) const {
  const Range z = z_range(*this);
  const auto r = static_cast<double>(radius);
  const double theta =
      std::lerp(std::acos(z.min / r), std::acos(z.max / r), static_cast<double>(uv.y));
  const double phi = static_cast<double>(uv.x) * azimuth_range(phi_max);
  const Vec3d n{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                std::cos(theta)};
  SurfacePoint on = point_at(n);
  on.uv = uv;
  return on;
}

Bounds3 Sphere::bounds() const {
  if (!(area_in_sphere_space(*this) > 0)) return {};
  // An ellipsoid reaches as far along an axis as that row of its map is long.
  const Affine world(world_from_sphere);
  const Range z = z_range(*this);
  const auto r = static_cast<double>(radius);
  const Vec3d x = world.column(0), y = world.column(1), w = world.column(2);
  const Vec3d reach{std::hypot(x.x, y.x, w.x) * r, std::hypot(x.y, y.y, w.y) * r,
                    std::hypot(x.z, y.z, w.z) * r};
  const Vec3d center = world.column(3);
  Bounds3 whole = enclosing(center - reach, center + reach);
  if (is_full()) return whole;
  // The box of the clipped sphere in its own space may be tighter.
  Bounds3 clipped;
  for (const double sx : {-r, r})
    for (const double sy : {-r, r})
      for (const double sz : {z.min, z.max}) {
        const Vec3d p = world.point({sx, sy, sz});
        clipped.extend(enclosing(p, p));
      }
  return {.min = max(whole.min, clipped.min), .max = min(whole.max, clipped.max)};
}

float Sphere::area() const {
  const Affine world(world_from_sphere);
  const double unstretched = area_in_sphere_space(*this);
  if (keeps_spheres(world))
    return static_cast<float>(unstretched * length(world.normal({0, 0, 1})));
  // The midpoint rule converges fast: the stretch is smooth over the sphere.
  constexpr int rows = 256, columns = 256;
  const Range z = z_range(*this);
  double sum = 0;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double height = std::lerp(z.min, z.max, (i + 0.5) / rows);
      const double phi = azimuth_range(phi_max) * (j + 0.5) / columns;
      sum += length(world.normal(direction(height / static_cast<double>(radius), phi)));
    }
  return static_cast<float>(unstretched * sum / (rows * columns));
}

ShapeSample Sphere::sample(Vec2 u) const {
  if (!(area_in_sphere_space(*this) > 0)) return {.point = {}, .pdf_area = 0};
  // Zones of equal height have equal areas [PBRT4, Sec. 6.2].
  const Range z = z_range(*this);
  const double height = std::lerp(z.min, z.max, static_cast<double>(u.x));
  const double phi = static_cast<double>(u.y) * azimuth_range(phi_max);
  const Vec3d n = direction(height / static_cast<double>(radius), phi);
  const double stretch = length(Affine(world_from_sphere).normal(n));
  return {.point = point_at(n),
          .pdf_area = static_cast<float>(1 / (area_in_sphere_space(*this) * stretch))};
}

float Sphere::pdf_area(const SurfacePoint& on) const {
  const Affine world(world_from_sphere);
  // Normals go to world space by the inverse transpose, so back by the transpose.
  const Vec3d n = normalize_or_z(world.transposed(Vec3d(on.ng)));
  const double a = area_in_sphere_space(*this) * length(world.normal(n));
  return a > 0 ? static_cast<float>(1 / a) : 0;
}

std::optional<ShapeDirectionSample> Sphere::sample_direction(Vec3 from, Vec2 u) const {
  const Affine world(world_from_sphere);
  // Where there is a cone or a shell the sphere is one in the world, too.
  const auto towards = [&](Vec3d normal, double world_radius, float pdf) {
    const Vec3 ng = to_float(flip_normals ? -normal : normal);
    return ShapeDirectionSample{
        .point = {.p = to_float(world.column(3) + normal * world_radius),
                  .ng = ng,
                  .ns = ng,
                  .uv = {}},
        .pdf = pdf};
  };
  if (const std::optional<Cone> cone = cone_from_outside(*this, world, from)) {
    const float pdf = cone_pdf(*cone);
    if (!(pdf > 0)) return std::nullopt;
    return towards(near_side_normal(*cone, u), cone->radius, pdf);
  }
  if (const std::optional<Shell> shell = shell_from_inside(*this, world, from))
    return towards(far_side_normal(*shell, u), shell->radius, inv_4pi);
  return sample_direction_by_area(*this, from, u);
}

float Sphere::direction_pdf(Vec3 from, const SurfacePoint& on) const {
  const Affine world(world_from_sphere);
  if (shell_from_inside(*this, world, from)) return inv_4pi;
  const std::optional<Cone> cone = cone_from_outside(*this, world, from);
  if (!cone) return direction_pdf_by_area(*this, from, on);
  // The far side is never sampled. The tolerance spares points of the rim from being taken
  // for it, which are on either side of it by rounding.
  const Vec3 to_viewer = from - on.p;
  const float cos = dot(flip_normals ? -on.ng : on.ng, to_viewer) / length(to_viewer);
  return cos < -1e-3f ? 0 : cone_pdf(*cone);
}

}  // namespace tyndall
