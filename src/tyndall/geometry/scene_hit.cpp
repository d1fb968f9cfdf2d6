// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/scene_hit.h"

#include <algorithm>
#include <optional>

namespace tyndall {
namespace {

// Robust intersections may be outside by a rounding error.
Vec2 clamp_to_triangle(Vec2 b) {
  b = {std::max(b.x, 0.0f), std::max(b.y, 0.0f)};
  const float sum = b.x + b.y;
  return sum > 1 ? b * (1 / sum) : b;
}

// Takes a hit at the point `p` from the space of an instance's group to the world.
void move_to_world(const InstanceMaps& instance, Vec3d p, SceneHit& hit) {
  const Affine& world = instance.world_from_group;
  const Vec3 ns = to_float(normalize_or_z(world.normal(Vec3d(hit.point.ns))));
  hit.group = instance.group;
  hit.point.p = to_float(world.point(p));
  hit.point.ng = to_float(normalize_or_z(world.normal(Vec3d(hit.point.ng))));
  hit.point.ns = dot(ns, hit.point.ng) < 0 ? -ns : ns;
}

SceneHit reconstruct_curved(const TargetShape& target, const RayHit& hit,
                            const PreciseRay& ray, const InstanceMaps* instance) {
  // The search told the distance only; the same arithmetic finds the same point again.
  const std::optional<PreciseHit> found = target.intersect(hit.primitive, ray, infinity);
  SceneHit result{
      .t = hit.t,
      .group = 0,
      .shape = hit.shape,
      .point = surface_point(target.shape(), hit.primitive, found ? found->uv : Vec2{})};
  const Vec3d p = found ? found->p : Vec3d(result.point.p);
  result.point.p = to_float(p);
  if (instance) move_to_world(*instance, p, result);
  return result;
}

}  // namespace

SceneHit reconstruct(const TargetShape& target, const RayHit& hit, const PreciseRay& ray,
                     const InstanceMaps* instance) {
  if (!target.mesh()) return reconstruct_curved(target, hit, ray, instance);
  const PreciseTriangle triangle = target.mesh()->triangle(hit.primitive);
  const Vec2 barycentric = clamp_to_triangle(hit.uv);
  SceneHit result{.t = hit.t,
                  .group = 0,
                  .shape = hit.shape,
                  .point = target.mesh()->point(hit.primitive, barycentric, triangle)};
  if (instance) move_to_world(*instance, triangle.position(barycentric), result);
  return result;
}

Crossing crossing_at(const TargetShape& target, const RayHit& hit, const PreciseRay& ray,
                     const InstanceMaps* instance, Vec3 world_d) {
  Crossing crossing{.t = hit.t,
                    .group = instance ? instance->group : 0,
                    .shape = hit.shape,
                    .goes_out = false};
  if (const TriangleMesh* mesh = target.mesh()) {
    // Affine maps keep the sides of surfaces: that of the ray in its own space will do.
    const Vec3d n = mesh->triangle(hit.primitive).normal();
    const bool is_turned = mesh->turns_outside(hit.primitive, clamp_to_triangle(hit.uv), n);
    crossing.goes_out = (dot(ray.d, n) > 0) != is_turned;
  } else {
    const SceneHit point = reconstruct_curved(target, hit, ray, instance);
    crossing.goes_out = dot(world_d, point.point.ng) > 0;
  }
  return crossing;
}

}  // namespace tyndall
