// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/intersector.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "tyndall/sampling/random.h"

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

struct InstanceTable {
  std::vector<InstanceMaps> maps;  // in the order of their geometry indices
  uint32_t first = 0;              // geometry index of the first

  // Null in the world.
  const InstanceMaps* of(uint32_t id) const {
    return id == RTC_INVALID_GEOMETRY_ID ? nullptr : &maps[id - first];
  }
};

PreciseRay precise_ray(const Ray& world_ray, const InstanceMaps* instance) {
  const PreciseRay ray{.o = Vec3d(world_ray.o), .d = Vec3d(world_ray.d)};
  return instance ? instance->group_ray(ray) : ray;
}

// A ray on its way through Embree. The first member is all that Embree knows of it.
struct RayContext {
  RTCIntersectContext embree;
  const Ray* world_ray;
  float t_max;
  const InstanceTable* instances;
  Crossings* crossings;  // where boundaries go that do not stop the ray; null if they do

  // The ray where the callback is: in an instance or in the world.
  PreciseRay current_ray() const {
    return precise_ray(*world_ray, instances->of(embree.instID[0]));
  }
  // Notes that the ray, or what is left of it, goes through a boundary.
  void cross(const TargetShape& target, const RayHit& hit, const PreciseRay& ray) const {
    crossings->push_back(
        crossing_at(target, hit, ray, instances->of(embree.instID[0]), world_ray->d));
  }
  static const RayContext& of(const RTCIntersectContext* embree) {
    return *reinterpret_cast<const RayContext*>(embree);
  }
};
static_assert(std::is_standard_layout_v<RTCIntersectContext>);

// What Embree hands back to its callbacks.
const TargetShape& target_of(const void* user_data) {
  return *static_cast<const TargetShape*>(user_data);
}

// Whether float cannot tell on which side of the triangle the ends of the ray are.
bool may_be_at_end(const TargetShape& target, const RTCRay& ray, const RTCHit& hit,
                   float t_max) {
  const float slope =
      std::abs(hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z);
  return target.may_be_at_end(ray.tfar, t_max, slope);
}

// Drops hits of the triangles that a ray starts from or ends on, which float cannot tell.
void drop_hit_of_ends(const RTCFilterFunctionNArguments* args) {
  assert(args->N == 1);
  const TargetShape& target = target_of(args->geometryUserPtr);
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  const RayContext& context = RayContext::of(args->context);
  if (args->context->instID[0] == RTC_INVALID_GEOMETRY_ID &&
      !may_be_at_end(target, ray, hit, context.t_max))
    return;
  if (!target.is_between_ends(hit.primID, context.current_ray(), context.t_max))
    args->valid[0] = 0;
}

// The same for shapes that only some rays meet.
void drop_hit_of_translucent(const RTCFilterFunctionNArguments* args) {
  drop_hit_of_ends(args);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  const PreciseRay ray = RayContext::of(args->context).current_ray();
  if (args->valid[0] && !target_of(args->geometryUserPtr).is_met_by(ray, hit.primID))
    args->valid[0] = 0;
}

// The same for boundaries, which are noted and dropped where they do not stop the ray.
void filter_boundary(const RTCFilterFunctionNArguments* args) {
  drop_hit_of_ends(args);
  const RayContext& context = RayContext::of(args->context);
  if (!context.crossings || !args->valid[0]) return;
  args->valid[0] = 0;
  const TargetShape& target = target_of(args->geometryUserPtr);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  const PreciseRay ray = context.current_ray();
  const double t = plane_distance(target.mesh()->triangle(hit.primID), ray);
  context.cross(target,
                {.t = static_cast<float>(t),
                 .group = 0,
                 .shape = hit.geomID,
                 .primitive = hit.primID,
                 .instance = hit.instID[0],
                 .uv = {hit.u, hit.v}},
                ray);
}

void find_bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds3 b = target_of(args->geometryUserPtr).primitive_bounds(args->primID);
  *args->bounds_o = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, 0};
}

void intersect_user_geometry(const RTCIntersectFunctionNArguments* args) {
  assert(args->N == 1);
  if (!args->valid[0]) return;
  auto& [ray, hit] = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const PreciseRay current = RayContext::of(args->context).current_ray();
  const std::optional<double> t =
      target_of(args->geometryUserPtr)
          .distance(args->primID, current, static_cast<double>(ray.tfar));
  if (!t) return;
  ray.tfar = static_cast<float>(*t);
  hit.primID = args->primID;
  hit.geomID = args->geomID;
  hit.instID[0] = args->context->instID[0];
}

// As often as a line can meet one curved primitive.
constexpr int max_crossings_of_primitive = 2;

void intersect_curved_boundary(const RTCIntersectFunctionNArguments* args) {
  const RayContext& context = RayContext::of(args->context);
  if (!context.crossings) return intersect_user_geometry(args);
  assert(args->N == 1);
  if (!args->valid[0]) return;
  const TargetShape& target = target_of(args->geometryUserPtr);
  const auto t_max = static_cast<double>(context.t_max);
  PreciseRay rest = context.current_ray();
  double t = 0;
  for (int i = 0; i < max_crossings_of_primitive; ++i) {
    const std::optional<PreciseHit> found = target.intersect(args->primID, rest, t_max - t);
    if (!found) return;
    t += found->t;
    context.cross(target,
                  {.t = static_cast<float>(t),
                   .group = 0,
                   .shape = args->geomID,
                   .primitive = args->primID,
                   .instance = context.embree.instID[0],
                   .uv = found->uv},
                  rest);
    rest.o = found->p;
  }
}

void occlude_user_geometry(const RTCOccludedFunctionNArguments* args) {
  assert(args->N == 1);
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  const PreciseRay current = RayContext::of(args->context).current_ray();
  if (target_of(args->geometryUserPtr)
          .distance(args->primID, current, static_cast<double>(ray.tfar)))
    ray.tfar = -infinity;
}

Handle<RTCGeometry> new_triangles(RTCDevice device, const TargetShape& target,
                                  bool is_boundary, bool is_instanced) {
  const TriangleMesh& mesh = *target.mesh();
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
  const RTCFilterFunctionN drop =
      target.is_translucent() ? drop_hit_of_translucent : drop_hit_of_ends;
  rtcSetGeometryOccludedFilterFunction(geometry.get(), drop);
  if (is_boundary)
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filter_boundary);
  else if (is_instanced || target.is_translucent())
    rtcSetGeometryIntersectFilterFunction(geometry.get(), drop);
  return geometry;
}

Handle<RTCGeometry> new_user_geometry(RTCDevice device, size_t primitives,
                                      bool is_boundary) {
  Handle<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(primitives));
  rtcSetGeometryBoundsFunction(geometry.get(), find_bounds, nullptr);
  rtcSetGeometryIntersectFunction(
      geometry.get(), is_boundary ? intersect_curved_boundary : intersect_user_geometry);
  rtcSetGeometryOccludedFunction(geometry.get(), occlude_user_geometry);
  return geometry;
}

uint32_t mask_of(const Intersector::Member& member) {
  return static_cast<uint32_t>(member.is_boundary ? RayMask::boundary : RayMask::opaque);
}

// Whether a ray that starts outside the box goes away from it. Exact: it misses then.
bool goes_away_from(const Bounds3& box, const Ray& ray) {
  for (int i = 0; i < 3; ++i)
    if ((ray.o[i] > box.max[i] && ray.d[i] >= 0) ||
        (ray.o[i] < box.min[i] && ray.d[i] <= 0))
      return true;
  return false;
}

Bounds3 bounds_of(RTCScene scene) {
  RTCBounds b;
  rtcGetSceneBounds(scene, &b);
  const Bounds3 result{.min = {b.lower_x, b.lower_y, b.lower_z},
                       .max = {b.upper_x, b.upper_y, b.upper_z}};
  return result.is_empty() ? Bounds3{} : result;
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

void drop_beyond(Crossings& crossings, float t) {
  const auto is_beyond = [&](const Crossing& crossing) { return crossing.t > t; };
  crossings.erase(std::remove_if(crossings.begin(), crossings.end(), is_beyond),
                  crossings.end());
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
    boundaries_ = new_scene();
    if (!rtcGetDeviceProperty(device_.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) ||
        !rtcGetDeviceProperty(device_.get(), RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED))
      throw std::runtime_error("this build of Embree lacks ray masks or filter functions");
    targets_.resize(groups.size());
    for (size_t i = 0; i < groups.size(); ++i)
      scenes_.push_back(new_scene(groups[i], targets_[i], i > 0));
    if (scenes_.empty()) scenes_.push_back(new_scene({}, targets_.emplace_back(), false));
    // The world last: its instances need their groups to be complete.
    for (size_t i = 1; i < scenes_.size(); ++i) rtcCommitScene(scenes_[i].get());
    add_instances(groups, instances);
    rtcCommitScene(scenes_[0].get());
    rtcCommitScene(boundaries_.get());
    throw_on_error(device_.get());
    boundary_bounds_ = bounds_of(boundaries_.get());
  }

  std::optional<RayHit> find(const Ray& ray, float t_max, RayMask mask,
                             Crossings* crossings) const {
    if (!can_hit(ray, t_max)) return std::nullopt;
    const bool boundaries_only = mask == RayMask::boundary;
    if (boundaries_only && goes_away_from(boundary_bounds_, ray)) return std::nullopt;
    const RTCScene scene = boundaries_only ? boundaries_.get() : scenes_[0].get();
    RayContext context = new_context(ray, t_max);
    context.crossings = crossings;
    RTCRayHit query{.ray = to_embree(ray, t_max, mask), .hit = no_hit()};
    for (;;) {
      rtcIntersect1(scene, &context.embree, &query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
      if (auto hit = finish_hit(context, query)) return hit;
      if (crossings) drop_beyond(*crossings, query.ray.tfar);  // they will be found again
      // It was a triangle at an end of the ray: go on behind it, by a number that is not
      // zero either where the processor takes denormal ones for it.
      constexpr float smallest = std::numeric_limits<float>::min();
      query.ray.tnear = std::max(std::nextafter(query.ray.tfar, infinity), smallest);
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

  SceneHit resolve(const Ray& ray, const RayHit& hit) const {
    const InstanceMaps* instance = instances_.of(hit.instance);
    return reconstruct(targets_[hit.group][hit.shape], hit, precise_ray(ray, instance),
                       instance);
  }

  Bounds3 bounds() const { return bounds_of(scenes_[0].get()); }

 private:
  Handle<RTCScene> new_scene() const {
    Handle<RTCScene> scene(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
  }

  // Fills `targets`, whose addresses Embree keeps.
  Handle<RTCScene> new_scene(const Group& group, std::vector<TargetShape>& targets,
                             bool is_instanced) {
    Handle<RTCScene> scene = new_scene();
    targets.reserve(group.size());
    for (size_t i = 0; i < group.size(); ++i) {
      const bool is_boundary = group[i].is_boundary;
      TargetShape& target = targets.emplace_back(
          *group[i].shape, is_boundary ? 1 : group[i].alpha, hash(scenes_.size(), i));
      const size_t primitives = target.primitive_count();
      if (primitives == 0) continue;
      const Handle<RTCGeometry> handle =
          target.mesh() ? new_triangles(device_.get(), target, is_boundary, is_instanced)
                        : new_user_geometry(device_.get(), primitives, is_boundary);
      rtcSetGeometryUserData(handle.get(), &target);
      rtcSetGeometryMask(handle.get(), mask_of(group[i]));
      rtcCommitGeometry(handle.get());
      rtcAttachGeometryByID(scene.get(), handle.get(), static_cast<unsigned>(i));
      if (is_boundary && !is_instanced)
        rtcAttachGeometryByID(boundaries_.get(), handle.get(), static_cast<unsigned>(i));
    }
    throw_on_error(device_.get());
    return scene;
  }

  void add_instances(std::span<const Group> groups, std::span<const Instance> instances) {
    instances_.first = static_cast<uint32_t>(targets_[0].size());
    for (size_t i = 0; i < instances.size(); ++i) {
      const auto& [group, world_from_group] = instances[i];
      assert(0 < group && group < groups.size());
      const Affine world = Affine(world_from_group).rounded();  // as Embree keeps it
      instances_.maps.push_back({group, world, world.inverse()});
      uint32_t mask = 0;
      for (const Member& member : groups[group]) mask |= mask_of(member);
      const Handle<RTCGeometry> handle(
          rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
      rtcSetGeometryInstancedScene(handle.get(), scenes_[group].get());
      rtcSetGeometryTransform(handle.get(), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                              world.floats().data());
      rtcSetGeometryMask(handle.get(), mask);
      rtcCommitGeometry(handle.get());
      const uint32_t id = instances_.first + static_cast<uint32_t>(i);
      rtcAttachGeometryByID(scenes_[0].get(), handle.get(), id);
      if (mask & static_cast<uint32_t>(RayMask::boundary))
        rtcAttachGeometryByID(boundaries_.get(), handle.get(), id);
    }
  }

  RayContext new_context(const Ray& ray, float t_max) const {
    RayContext context;
    rtcInitIntersectContext(&context.embree);
    context.world_ray = &ray;
    context.t_max = t_max;
    context.instances = &instances_;
    context.crossings = nullptr;
    return context;
  }

  // Empty if the hit is of a triangle that the ray starts from or ends on.
  std::optional<RayHit> finish_hit(const RayContext& context,
                                   const RTCRayHit& query) const {
    const auto& [ray, hit] = query;
    const InstanceMaps* instance = instances_.of(hit.instID[0]);
    RayHit result{.t = ray.tfar,
                  .group = instance ? instance->group : 0,
                  .shape = hit.geomID,
                  .primitive = hit.primID,
                  .instance = hit.instID[0],
                  .uv = {hit.u, hit.v}};
    const TargetShape& target = targets_[result.group][hit.geomID];
    if (!target.mesh()) return result;
    const PreciseRay precise = precise_ray(*context.world_ray, instance);
    if ((instance || may_be_at_end(target, ray, hit, context.t_max)) &&
        !target.is_between_ends(hit.primID, precise, context.t_max))
      return std::nullopt;
    result.t =
        static_cast<float>(plane_distance(target.mesh()->triangle(hit.primID), precise));
    return result;
  }

  Handle<RTCDevice> device_;
  std::vector<std::vector<TargetShape>> targets_;  // by group and shape
  std::vector<Handle<RTCScene>> scenes_;           // by group
  // The boundaries of the world once more: rays for transmittance need not wade through the
  // rest, and see at once when there are no more.
  Handle<RTCScene> boundaries_;
  Bounds3 boundary_bounds_;
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
  const std::optional<RayHit> hit = find(ray, t_max, mask);
  return hit ? std::optional<SceneHit>(resolve(ray, *hit)) : std::nullopt;
}

std::optional<RayHit> Intersector::find(const Ray& ray, float t_max, RayMask mask) const {
  return impl_->find(ray, t_max, mask, nullptr);
}

std::optional<RayHit> Intersector::find_through(const Ray& ray, float t_max, RayMask mask,
                                                Crossings& crossings) const {
  crossings.clear();
  const std::optional<RayHit> hit = impl_->find(ray, t_max, mask, &crossings);
  if (hit) drop_beyond(crossings, hit->t);
  std::ranges::sort(crossings, {}, &Crossing::t);
  return hit;
}

SceneHit Intersector::resolve(const Ray& ray, const RayHit& hit) const {
  return impl_->resolve(ray, hit);
}

bool Intersector::is_occluded(const Ray& ray, float t_max, RayMask mask) const {
  return impl_->is_occluded(ray, t_max, mask);
}

Bounds3 Intersector::bounds() const { return impl_->bounds(); }

}  // namespace tyndall
