// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/ray_intersection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tyndall/geometry/azimuth.h"

namespace tyndall {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

bool is_within(double t, double t_max) { return t > 0 && t < t_max; }

// Whether a ray whose distance to the plane that touches the surface at its hit is
// `distance` starts from the surface itself, as far as double precision tells. `size`
// bounds the numbers that the distance was computed from.
bool starts_on_surface(double distance, double size) {
  return !(std::abs(distance) > 1e-14 * size);
}

}  // namespace

SphereIntersector::SphereIntersector(const Sphere& sphere)
    : sphere_(sphere),
      world_from_sphere_(sphere.world_from_sphere),
      sphere_from_world_(world_from_sphere_.inverse()),
      radius_(static_cast<double>(sphere.radius)),
      phi_max_(azimuth_range(sphere.phi_max)) {
  const float low = std::min(sphere.z_min, sphere.z_max);
  const float high = std::max(sphere.z_min, sphere.z_max);
  z_min_ = low <= -sphere.radius ? -no_limit : static_cast<double>(low) / radius_;
  z_max_ = high >= sphere.radius ? no_limit : static_cast<double>(high) / radius_;
}

bool SphereIntersector::is_clipped_away(Vec3d n) const {
  return n.z < z_min_ || n.z > z_max_ ||
         (phi_max_ < full_turn && azimuth(n.x, n.y) > phi_max_);
}

std::optional<SphereIntersector::Found> SphereIntersector::find(const PreciseRay& ray,
                                                                double t_max) const {
  const Vec3d o = sphere_from_world_.point(ray.o), d = sphere_from_world_.vector(ray.d);
  // From the point of the line that is closest to the center both ways to the surface: this
  // loses no digits for a far origin, as the textbook discriminant does.
  const double dd = dot(d, d);
  const double t_closest = -dot(o, d) / dd;
  const Vec3d closest = o + d * t_closest;
  const double half_chord2 = radius_ * radius_ - dot(closest, closest);
  if (!(half_chord2 >= 0) || !(radius_ > 0)) return std::nullopt;
  const double half_t = std::sqrt(half_chord2 / dd);
  for (const double t : {t_closest - half_t, t_closest + half_t}) {
    if (!is_within(t, t_max)) continue;
    const Vec3d n = normalize_or_z(o + d * t);
    if (starts_on_surface(t * dot(n, d), length(o) + radius_) || is_clipped_away(n))
      continue;
    return Found{t, n};
  }
  return std::nullopt;
}

std::optional<PreciseHit> SphereIntersector::intersect(const PreciseRay& ray,
                                                       double t_max) const {
  const std::optional<Found> found = find(ray, t_max);
  if (!found) return std::nullopt;
  return PreciseHit{.t = found->t,
                    .uv = sphere_.parameters(found->n),
                    .p = world_from_sphere_.point(found->n * radius_)};
}

std::optional<double> SphereIntersector::distance(const PreciseRay& ray,
                                                  double t_max) const {
  const std::optional<Found> found = find(ray, t_max);
  return found ? std::optional<double>(found->t) : std::nullopt;
}

DiskIntersector::DiskIntersector(const Disk& disk)
    : world_from_disk_(disk.world_from_disk),
      disk_from_world_(world_from_disk_.inverse()),
      height_(static_cast<double>(disk.height)),
      radius_(static_cast<double>(disk.radius)),
      inner_radius_(static_cast<double>(disk.inner_radius)),
      phi_max_(azimuth_range(disk.phi_max)) {}

std::optional<DiskIntersector::Found> DiskIntersector::find(const PreciseRay& ray,
                                                            double t_max) const {
  const Vec3d o = disk_from_world_.point(ray.o), d = disk_from_world_.vector(ray.d);
  const double t = (height_ - o.z) / d.z;
  if (!is_within(t, t_max) || starts_on_surface(height_ - o.z, length(o) + radius_))
    return std::nullopt;
  const double x = o.x + d.x * t, y = o.y + d.y * t;
  const double r = std::hypot(x, y);
  if (!(r <= radius_ && r >= inner_radius_ && radius_ > inner_radius_)) return std::nullopt;
  if (phi_max_ < full_turn && azimuth(x, y) > phi_max_) return std::nullopt;
  return Found{t, x, y, r};
}

std::optional<PreciseHit> DiskIntersector::intersect(const PreciseRay& ray,
                                                     double t_max) const {
  const std::optional<Found> found = find(ray, t_max);
  if (!found) return std::nullopt;
  const auto [t, x, y, r] = *found;
  return PreciseHit{.t = t,
                    .uv = {static_cast<float>(azimuth(x, y) / phi_max_),
                           static_cast<float>((radius_ - r) / (radius_ - inner_radius_))},
                    .p = world_from_disk_.point({x, y, height_})};
}

std::optional<double> DiskIntersector::distance(const PreciseRay& ray, double t_max) const {
  const std::optional<Found> found = find(ray, t_max);
  return found ? std::optional<double>(found->t) : std::nullopt;
}

bool starts_in_front(const PreciseTriangle& triangle, const PreciseRay& ray) {
  const Vec3d n = triangle.normal(), to_corner = triangle.p0 - ray.o;
  const double distance = dot(to_corner, n);
  // The rounding of the products that make up the distance, several times over.
  const double error = 1e-15 * taxicab_length(to_corner) * taxicab_length(triangle.edge1) *
                       taxicab_length(triangle.edge2);
  return distance / dot(ray.d, n) > 0 && std::abs(distance) > error;
}

std::optional<PreciseHit> intersect_patch(const BilinearPatch& patch, const PreciseRay& ray,
                                          double t_max) {
  // The ruling of u starts at q(u) = q0 + u e, seen from the ray's origin, and runs along
  // w(u) = w0 + u g. Ray and ruling meet where (q x d) . w = 0, a quadratic equation in u.
  const Vec3d q0 = patch.p00 - ray.o, e = patch.p10 - patch.p00;
  const Vec3d w0 = patch.p01 - patch.p00, g = patch.p11 - patch.p10 - w0;
  const Vec3d q0d = cross(q0, ray.d), ed = cross(e, ray.d);
  const double c0 = dot(q0d, w0), c1 = dot(q0d, g) + dot(ed, w0), c2 = dot(ed, g);
  const double discriminant = c1 * c1 - 4 * c2 * c0;
  if (!(discriminant >= 0)) return std::nullopt;
  const double half = -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
  std::optional<PreciseHit> closest;
  for (const double root : {half / c2, c0 / half}) {
    // The edge belongs to both neighbors, which round it differently.
    constexpr double tolerance = 1e-12;
    if (!(root >= -tolerance && root <= 1 + tolerance)) continue;
    const double u = std::clamp(root, 0.0, 1.0);
    const Vec3d q = q0 + e * u, w = w0 + g * u;
    const Vec3d dw = cross(ray.d, w);
    const double dw2 = dot(dw, dw);
    const double t = dot(cross(q, w), dw) / dw2;
    const double v = dot(cross(q, ray.d), dw) / dw2;
    if (!is_within(t, closest ? closest->t : t_max)) continue;
    if (!(v >= -tolerance && v <= 1 + tolerance)) continue;
    const double v_inside = std::clamp(v, 0.0, 1.0);
    const Vec3d n = patch.normal(u, v_inside);
    const Vec3d p = patch.position(u, v_inside);
    // Not t * dot(n, ray.d): t is inexact for rays that are all but parallel to w.
    if (starts_on_surface(dot(p - ray.o, n),
                          length(n) * (length(q) + length(e) + length(w))))
      continue;
    closest = PreciseHit{
        .t = t, .uv = {static_cast<float>(u), static_cast<float>(v_inside)}, .p = p};
  }
  return closest;
}

}  // namespace tyndall
