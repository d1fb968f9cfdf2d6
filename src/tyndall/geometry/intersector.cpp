// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/intersector.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "tyndall/geometry/precise.h"
#include "tyndall/geometry/ray_intersection.h"

namespace tyndall {
namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename T>
using Handle = std::unique_ptr<std::remove_pointer_t<T>, Release>;

void throw_on_error(RTCDevice device) {
  switch (const RTCError error = rtcGetDeviceError(device)) {
    case RTC_ERROR_NONE:
      return;
    case RTC_ERROR_OUT_OF_MEMORY:
      throw std::runtime_error("out of memory while building the ray tracing structures");
    default:
      throw std::runtime_error(fmt::format("Embree failed with error {} while building",
                                           static_cast<int>(error)));
  }
}

struct InstanceMaps {
  uint32_t group;
  Affine world_from_group, group_from_world;
};

// What Embree hands back to its callbacks as the "user data" of a geometry.
struct Geometry {
  const Shape* shape;
  const TriangleMesh* mesh;  // null if another shape
  std::variant<std::monostate, SphereIntersector, DiskIntersector> quadric;
  float longest_edge = 0;  // of the mesh
};

struct InstanceTable {
  std::vector<InstanceMaps> maps;  // in the order of their geometry indices
  uint32_t first = 0;              // geometry index of the first
};

// A ray on its way through Embree. The first member is all that Embree knows of it.
struct RayContext {
  RTCIntersectContext embree;
  const Ray* world_ray;
  float t_max;
  const InstanceTable* instances;

  const InstanceMaps* instance(uint32_t id) const {
    return id == RTC_INVALID_GEOMETRY_ID ? nullptr
                                         : &instances->maps[id - instances->first];
  }
  PreciseRay ray_in(const InstanceMaps* instance) const {
    const Vec3d o(world_ray->o), d(world_ray->d);
    if (!instance) return {.o = o, .d = d};
    return {.o = instance->group_from_world.point(o),
            .d = instance->group_from_world.vector(d)};
  }
  // The ray where the callback is: in an instance or in the world.
  PreciseRay current_ray() const { return ray_in(instance(embree.instID[0])); }
  static const RayContext& of(const RTCIntersectContext* embree) {
    return *reinterpret_cast<const RayContext*>(embree);
  }
};
static_assert(std::is_standard_layout_v<RTCIntersectContext>);

float longest_edge(const TriangleMesh& mesh) {
  double longest2 = 0;
  for (uint32_t i = 0; i < mesh.triangles().size(); ++i) {
    const PreciseTriangle triangle = mesh.triangle(i);
    for (const Vec3d edge :
         {triangle.edge1, triangle.edge2, triangle.edge2 - triangle.edge1})
      if (dot(edge, edge) > longest2) longest2 = dot(edge, edge);
  }
  return static_cast<float>(std::sqrt(longest2));
}

// Whether a triangle is in front of the ray and not behind its end.
bool is_between_ends(const PreciseTriangle& triangle, const PreciseRay& ray, float t_max) {
  return starts_in_front(triangle, ray) &&
         plane_distance(triangle, ray) < static_cast<double>(t_max);
}

std::optional<PreciseHit> intersect_curved(const Geometry& geometry, uint32_t primitive,
                                           const PreciseRay& ray, double t_max) {
  if (const auto* sphere = std::get_if<SphereIntersector>(&geometry.quadric))
    return sphere->intersect(ray, t_max);
  if (const auto* disk = std::get_if<DiskIntersector>(&geometry.quadric))
    return disk->intersect(ray, t_max);
  return intersect_patch(std::get<BilinearMesh>(*geometry.shape).patch(primitive), ray,
                         t_max);
}

// Drops hits of the triangles that a ray starts from or ends on, which float cannot tell.
void drop_hit_of_ends(const RTCFilterFunctionNArguments* args) {
  assert(args->N == 1);
  const auto& geometry = *static_cast<const Geometry*>(args->geometryUserPtr);
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  const float t_max = RayContext::of(args->context).t_max;
  // Distances to the triangle's plane times twice its area, and how wrong Embree may be
  // about them: a few roundings of products of lengths up to these.
  const float slope =
      std::abs(hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z);
  const float nearest_end = std::min(ray.tfar, t_max - ray.tfar) * slope;
  const float error =
      32 * 0x1p-23f * sqr(geometry.longest_edge) * (geometry.longest_edge + ray.tfar);
  if (nearest_end > error && args->context->instID[0] == RTC_INVALID_GEOMETRY_ID) return;
  const PreciseRay current = RayContext::of(args->context).current_ray();
  if (!is_between_ends(geometry.mesh->triangle(hit.primID), current, t_max))
    args->valid[0] = 0;
}

Bounds3 primitive_bounds(const Geometry& geometry, uint32_t primitive) {
  const auto* mesh = std::get_if<BilinearMesh>(geometry.shape);
  if (!mesh) return bounds(*geometry.shape);
  Bounds3 b;
  const BilinearPatch patch = mesh->patch(primitive);
  for (const Vec3d p : {patch.p00, patch.p10, patch.p01, patch.p11}) {
    if (!is_finite(to_float(p))) return {};
    b.extend(to_float(p));
  }
  return b;
}

void find_bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds3 b =
      primitive_bounds(*static_cast<const Geometry*>(args->geometryUserPtr), args->primID);
  *args->bounds_o = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, 0};
}

void intersect_user_geometry(const RTCIntersectFunctionNArguments* args) {
  assert(args->N == 1);
  if (!args->valid[0]) return;
  const auto& geometry = *static_cast<const Geometry*>(args->geometryUserPtr);
  auto& [ray, hit] = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const PreciseRay current = RayContext::of(args->context).current_ray();
  const std::optional<PreciseHit> found =
      intersect_curved(geometry, args->primID, current, static_cast<double>(ray.tfar));
  if (!found) return;
  ray.tfar = static_cast<float>(found->t);
  hit.u = found->uv.x;
  hit.v = found->uv.y;
  hit.primID = args->primID;
  hit.geomID = args->geomID;
  hit.instID[0] = args->context->instID[0];
}

void occlude_user_geometry(const RTCOccludedFunctionNArguments* args) {
  assert(args->N == 1);
  if (!args->valid[0]) return;
  const auto& geometry = *static_cast<const Geometry*>(args->geometryUserPtr);
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  const PreciseRay current = RayContext::of(args->context).current_ray();
  if (intersect_curved(geometry, args->primID, current, static_cast<double>(ray.tfar)))
    ray.tfar = -infinity;
}

Handle<RTCGeometry> new_triangles(RTCDevice device, const TriangleMesh& mesh,
                                  bool is_instanced) {
  Handle<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  void* vertices =
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(Vec3), mesh.positions().size());
  throw_on_error(device);
  std::copy(mesh.positions().begin(), mesh.positions().end(), static_cast<Vec3*>(vertices));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles().data(), 0, sizeof(Vec3i),
                             mesh.triangles().size());
  // In the world intersect() checks the closest hit itself, which costs less than a
  // callback for each; an occlusion test does not tell what it hit.
  rtcSetGeometryOccludedFilterFunction(geometry.get(), drop_hit_of_ends);
  if (is_instanced) rtcSetGeometryIntersectFilterFunction(geometry.get(), drop_hit_of_ends);
  return geometry;
}

Handle<RTCGeometry> new_user_geometry(RTCDevice device, size_t primitives) {
  Handle<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(primitives));
  rtcSetGeometryBoundsFunction(geometry.get(), find_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), intersect_user_geometry);
  rtcSetGeometryOccludedFunction(geometry.get(), occlude_user_geometry);
  return geometry;
}

size_t primitive_count(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return mesh->triangles().size();
  if (const auto* mesh = std::get_if<BilinearMesh>(&shape)) return mesh->patches().size();
  return 1;
}

Geometry make_geometry(const Shape& shape) {
  Geometry geometry{
      .shape = &shape, .mesh = std::get_if<TriangleMesh>(&shape), .quadric = {}};
  if (geometry.mesh) geometry.longest_edge = longest_edge(*geometry.mesh);
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    geometry.quadric.emplace<SphereIntersector>(*sphere);
  if (const auto* disk = std::get_if<Disk>(&shape))
    geometry.quadric.emplace<DiskIntersector>(*disk);
  return geometry;
}

uint32_t mask_of(const Intersector::Member& member) {
  return static_cast<uint32_t>(member.is_boundary ? RayMask::boundary : RayMask::opaque);
}

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

// Embree takes coordinates up to 1.8e18.
bool can_hit(const Ray& ray, float t_max) {
  const float o2 = length_squared(ray.o), d2 = length_squared(ray.d);
  return o2 < 1e36f && d2 < 1e36f && d2 > 0 && t_max > 0;
}

RTCRay to_embree(const Ray& ray, float t_max, RayMask mask) {
  return {.org_x = ray.o.x,
          .org_y = ray.o.y,
          .org_z = ray.o.z,
          .tnear = 0,
          .dir_x = ray.d.x,
          .dir_y = ray.d.y,
          .dir_z = ray.d.z,
          .time = 0,
          .tfar = t_max,
          .mask = static_cast<uint32_t>(mask),
          .id = 0,
          .flags = 0};
}

RTCHit no_hit() {
  RTCHit hit{};
  hit.geomID = hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return hit;
}

}  // namespace

class Intersector::Impl {
 public:
  Impl(std::span<const Group> groups, std::span<const Instance> instances)
      : device_(rtcNewDevice(nullptr)) {
    throw_on_error(device_.get());
    if (!rtcGetDeviceProperty(device_.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) ||
        !rtcGetDeviceProperty(device_.get(), RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED))
      throw std::runtime_error("this build of Embree lacks ray masks or filter functions");
    geometries_.resize(groups.size());
    for (size_t i = 0; i < groups.size(); ++i)
      scenes_.push_back(new_scene(groups[i], geometries_[i], i > 0));
    if (scenes_.empty())
      scenes_.push_back(new_scene({}, geometries_.emplace_back(), false));
    // The world last: its instances need their groups to be complete.
    for (size_t i = 1; i < scenes_.size(); ++i) rtcCommitScene(scenes_[i].get());
    add_instances(groups, instances);
    rtcCommitScene(scenes_[0].get());
    throw_on_error(device_.get());
  }

  std::optional<SceneHit> intersect(const Ray& ray, float t_max, RayMask mask) const {
    if (!can_hit(ray, t_max)) return std::nullopt;
    RayContext context = new_context(ray, t_max);
    RTCRayHit query{.ray = to_embree(ray, t_max, mask), .hit = no_hit()};
    for (;;) {
      rtcIntersect1(scenes_[0].get(), &context.embree, &query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
      if (is_proper(context, query.hit)) return reconstruct(context, query);
      // It was a triangle at an end of the ray: go on behind it.
      query.ray.tnear = std::nextafter(query.ray.tfar, infinity);
      query.ray.tfar = t_max;
      query.hit = no_hit();
      if (!(query.ray.tnear < t_max)) return std::nullopt;
    }
  }

  bool is_occluded(const Ray& ray, float t_max, RayMask mask) const {
    if (!can_hit(ray, t_max)) return false;
    RayContext context = new_context(ray, t_max);
    RTCRay query = to_embree(ray, t_max, mask);
    rtcOccluded1(scenes_[0].get(), &context.embree, &query);
    return query.tfar < 0;
  }

  Bounds3 bounds() const {
    RTCBounds b;
    rtcGetSceneBounds(scenes_[0].get(), &b);
    const Bounds3 result{.min = {b.lower_x, b.lower_y, b.lower_z},
                         .max = {b.upper_x, b.upper_y, b.upper_z}};
    return result.is_empty() ? Bounds3{} : result;
  }

 private:
  // Fills `geometries`, whose addresses Embree keeps.
  Handle<RTCScene> new_scene(const Group& group, std::vector<Geometry>& geometries,
                             bool is_instanced) {
    Handle<RTCScene> scene(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    geometries.reserve(group.size());
    for (size_t i = 0; i < group.size(); ++i) {
      Geometry& geometry = geometries.emplace_back(make_geometry(*group[i].shape));
      const size_t primitives = primitive_count(*geometry.shape);
      if (primitives == 0) continue;
      const Handle<RTCGeometry> handle =
          geometry.mesh ? new_triangles(device_.get(), *geometry.mesh, is_instanced)
                        : new_user_geometry(device_.get(), primitives);
      rtcSetGeometryUserData(handle.get(), &geometry);
      rtcSetGeometryMask(handle.get(), mask_of(group[i]));
      rtcCommitGeometry(handle.get());
      rtcAttachGeometryByID(scene.get(), handle.get(), static_cast<unsigned>(i));
    }
    throw_on_error(device_.get());
    return scene;
  }

  void add_instances(std::span<const Group> groups, std::span<const Instance> instances) {
    instances_.first = static_cast<uint32_t>(geometries_[0].size());
    for (size_t i = 0; i < instances.size(); ++i) {
      const auto& [group, world_from_group] = instances[i];
      assert(0 < group && group < groups.size());
      const Affine world(world_from_group);
      instances_.maps.push_back({group, world, world.inverse()});
      uint32_t mask = 0;
      for (const Member& member : groups[group]) mask |= mask_of(member);
      const Handle<RTCGeometry> handle(
          rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
      rtcSetGeometryInstancedScene(handle.get(), scenes_[group].get());
      rtcSetGeometryTransform(handle.get(), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                              world_from_group.matrix().data());
      rtcSetGeometryMask(handle.get(), mask);
      rtcCommitGeometry(handle.get());
      rtcAttachGeometryByID(scenes_[0].get(), handle.get(),
                            instances_.first + static_cast<uint32_t>(i));
    }
  }

  RayContext new_context(const Ray& ray, float t_max) const {
    RayContext context;
    rtcInitIntersectContext(&context.embree);
    context.world_ray = &ray;
    context.t_max = t_max;
    context.instances = &instances_;
    return context;
  }

  const Geometry& geometry_of(const InstanceMaps* instance, const RTCHit& hit) const {
    return geometries_[instance ? instance->group : 0][hit.geomID];
  }

  // Whether the hit is not of a triangle that the ray starts from or ends on.
  bool is_proper(const RayContext& context, const RTCHit& hit) const {
    const InstanceMaps* instance = context.instance(hit.instID[0]);
    const Geometry& geometry = geometry_of(instance, hit);
    return !geometry.mesh || is_between_ends(geometry.mesh->triangle(hit.primID),
                                             context.ray_in(instance), context.t_max);
  }

  SceneHit reconstruct(const RayContext& context, const RTCRayHit& query) const {
    const RTCHit& hit = query.hit;
    const InstanceMaps* instance = context.instance(hit.instID[0]);
    const Geometry& geometry = geometry_of(instance, hit);
    if (!geometry.mesh) return reconstruct_curved(context, query);
    const PreciseTriangle triangle = geometry.mesh->triangle(hit.primID);
    const Vec2 barycentric = clamp_to_triangle({hit.u, hit.v});
    const double t = plane_distance(triangle, context.ray_in(instance));
    SceneHit result{.t = static_cast<float>(t),
                    .group = 0,
                    .shape = hit.geomID,
                    .point = geometry.mesh->point(hit.primID, barycentric, triangle)};
    if (instance) move_to_world(*instance, triangle.position(barycentric), result);
    return result;
  }

  SceneHit reconstruct_curved(const RayContext& context, const RTCRayHit& query) const {
    const auto& [ray, hit] = query;
    const InstanceMaps* instance = context.instance(hit.instID[0]);
    const Geometry& geometry = geometry_of(instance, hit);
    SceneHit result{.t = ray.tfar,
                    .group = 0,
                    .shape = hit.geomID,
                    .point = surface_point(*geometry.shape, hit.primID, {hit.u, hit.v})};
    // Embree has room for floats only; the same arithmetic finds the same point again.
    const std::optional<PreciseHit> found =
        intersect_curved(geometry, hit.primID, context.ray_in(instance), infinity);
    const Vec3d p = found ? found->p : Vec3d(result.point.p);
    result.point.p = to_float(p);
    if (instance) move_to_world(*instance, p, result);
    return result;
  }

  Handle<RTCDevice> device_;
  std::vector<std::vector<Geometry>> geometries_;  // by group and shape
  std::vector<Handle<RTCScene>> scenes_;           // by group
  InstanceTable instances_;
};

Intersector::Intersector(std::span<const Group> groups,
                         std::span<const Instance> instances) try
    : impl_(std::make_unique<Impl>(groups, instances)) {
} catch (const std::bad_alloc&) {
  throw std::runtime_error("out of memory while building the ray tracing structures");
}

Intersector::~Intersector() = default;

std::optional<SceneHit> Intersector::intersect(const Ray& ray, float t_max,
                                               RayMask mask) const {
  return impl_->intersect(ray, t_max, mask);
}

bool Intersector::is_occluded(const Ray& ray, float t_max, RayMask mask) const {
  return impl_->is_occluded(ray, t_max, mask);
}

Bounds3 Intersector::bounds() const { return impl_->bounds(); }

}  // namespace tyndall
