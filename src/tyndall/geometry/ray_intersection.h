// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/geometry/bilinear_mesh.h"
#include "tyndall/geometry/disk.h"
#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/sphere.h"
#include "tyndall/geometry/triangle_mesh.h"

namespace tyndall {

/// A ray in double precision; `d` need not be unit, distances along it are in its length.
struct PreciseRay {
  Vec3d o, d;

  Vec3d at(double t) const { return o + d * t; }
};

/// Where a ray meets a surface.
struct PreciseHit {
  double t;
  Vec2 uv;  ///< the shape's own parameters
  Vec3d p;  ///< on the surface to double precision, in the space of the ray
};

/// Distance to the plane of a triangle.
inline double plane_distance(const PreciseTriangle& triangle, const PreciseRay& ray) {
  const Vec3d n = triangle.normal();
  return dot(triangle.p0 - ray.o, n) / dot(ray.d, n);
}

/// Whether the ray goes towards the plane of the triangle and does not start from it.
bool starts_in_front(const PreciseTriangle& triangle, const PreciseRay& ray);

// Each finds the closest hit at a distance in (0, t_max). Rays with components that are not
// finite hit nothing, and a surface that the ray starts from is not hit there.

/// A sphere with its maps and clips ready for rays.
class SphereIntersector {
 public:
  explicit SphereIntersector(const Sphere& sphere);
  std::optional<PreciseHit> intersect(const PreciseRay& ray, double t_max) const;
  /// The distance of intersect() alone, for less.
  std::optional<double> distance(const PreciseRay& ray, double t_max) const;

 private:
  struct Found {
    double t;
    Vec3d n;  // on the unit sphere
  };
  std::optional<Found> find(const PreciseRay& ray, double t_max) const;
  bool is_clipped_away(Vec3d n) const;

  Sphere sphere_;
  Affine world_from_sphere_, sphere_from_world_;
  double radius_;
  double z_min_, z_max_;  // on the unit sphere, beyond it where nothing is clipped
  double phi_max_;
};

/// A disk with its maps and clips ready for rays.
class DiskIntersector {
 public:
  explicit DiskIntersector(const Disk& disk);
  std::optional<PreciseHit> intersect(const PreciseRay& ray, double t_max) const;
  /// The distance of intersect() alone, for less.
  std::optional<double> distance(const PreciseRay& ray, double t_max) const;

 private:
  struct Found {
    double t, x, y, r;  // in the space of the disk
  };
  std::optional<Found> find(const PreciseRay& ray, double t_max) const;

  Affine world_from_disk_, disk_from_world_;
  double height_, radius_, inner_radius_;
  double phi_max_;
};

/// The hit with a patch, by the quadratic equation for the ruling (a line of constant u)
/// that the ray meets.
std::optional<PreciseHit> intersect_patch(const BilinearPatch& patch, const PreciseRay& ray,
                                          double t_max);

}  // namespace tyndall
