// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/target_shape.h"

#include <bit>
#include <cmath>

#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

float longest_edge_of(const TriangleMesh& mesh) {
  double longest2 = 0;
  for (uint32_t i = 0; i < mesh.triangles().size(); ++i) {
    const PreciseTriangle triangle = mesh.triangle(i);
    for (const Vec3d edge :
         {triangle.edge1, triangle.edge2, triangle.edge2 - triangle.edge1})
      if (dot(edge, edge) > longest2) longest2 = dot(edge, edge);
  }
  return static_cast<float>(std::sqrt(longest2));
}

// As often as a line can meet one curved primitive.
constexpr int max_hits_of_primitive = 2;

}  // namespace

TargetShape::TargetShape(const Shape& shape, float alpha, uint64_t salt)
    : shape_(&shape), mesh_(std::get_if<TriangleMesh>(&shape)), alpha_(alpha), salt_(salt) {
  if (mesh_) longest_edge_ = longest_edge_of(*mesh_);
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    quadric_.emplace<SphereIntersector>(*sphere);
  if (const auto* disk = std::get_if<Disk>(&shape))
    quadric_.emplace<DiskIntersector>(*disk);
}

size_t TargetShape::primitive_count() const {
  if (mesh_) return mesh_->triangles().size();
  if (const auto* mesh = std::get_if<BilinearMesh>(shape_)) return mesh->patches().size();
  return 1;
}

Bounds3 TargetShape::primitive_bounds(uint32_t primitive) const {
  const auto* mesh = std::get_if<BilinearMesh>(shape_);
  if (!mesh) return bounds(*shape_);
  Bounds3 b;
  const BilinearPatch patch = mesh->patch(primitive);
  for (const Vec3d p : {patch.p00, patch.p10, patch.p01, patch.p11}) {
    if (!is_finite(to_float(p))) return {};
    b.extend(to_float(p));
  }
  return b;
}

bool TargetShape::is_met_by(const PreciseRay& ray, uint32_t primitive, int n) const {
  const auto bits = [](double x) { return std::bit_cast<uint64_t>(x); };
  const uint64_t h = hash(bits(ray.o.x), bits(ray.o.y), bits(ray.o.z), bits(ray.d.x),
                          bits(ray.d.y), bits(ray.d.z), salt_, primitive, n);
  return uniform_float(static_cast<uint32_t>(h >> 32)) < alpha_;
}

std::optional<PreciseHit> TargetShape::intersect(uint32_t primitive, const PreciseRay& ray,
                                                 double t_max) const {
  if (!is_translucent()) return closest(primitive, ray, t_max);
  PreciseRay rest = ray;
  double t = 0;
  for (int n = 0; n < max_hits_of_primitive; ++n) {
    std::optional<PreciseHit> hit = closest(primitive, rest, t_max - t);
    if (!hit) return std::nullopt;
    hit->t += t;
    if (is_met_by(ray, primitive, n)) return hit;
    t = hit->t;
    rest.o = hit->p;
  }
  return std::nullopt;
}

std::optional<PreciseHit> TargetShape::closest(uint32_t primitive, const PreciseRay& ray,
                                               double t_max) const {
  if (const auto* sphere = std::get_if<SphereIntersector>(&quadric_))
    return sphere->intersect(ray, t_max);
  if (const auto* disk = std::get_if<DiskIntersector>(&quadric_))
    return disk->intersect(ray, t_max);
  return intersect_patch(std::get<BilinearMesh>(*shape_).patch(primitive), ray, t_max);
}

std::optional<double> TargetShape::distance(uint32_t primitive, const PreciseRay& ray,
                                            double t_max) const {
  if (is_translucent()) {
    const std::optional<PreciseHit> hit = intersect(primitive, ray, t_max);
    return hit ? std::optional(hit->t) : std::nullopt;
  }
  if (const auto* sphere = std::get_if<SphereIntersector>(&quadric_))
    return sphere->distance(ray, t_max);
  if (const auto* disk = std::get_if<DiskIntersector>(&quadric_))
    return disk->distance(ray, t_max);
  const std::optional<PreciseHit> hit = intersect(primitive, ray, t_max);
  return hit ? std::optional<double>(hit->t) : std::nullopt;
}

}  // namespace tyndall
