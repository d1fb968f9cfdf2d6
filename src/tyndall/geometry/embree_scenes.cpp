// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/embree_scenes.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

static_assert(InstanceTable::none == RTC_INVALID_GEOMETRY_ID);

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

void find_bounds(const RTCBoundsFunctionArguments* args) {
  const TargetShape& target = *static_cast<const TargetShape*>(args->geometryUserPtr);
  const Bounds3 b = target.primitive_bounds(args->primID);
  *args->bounds_o = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, 0};
}

uint32_t mask_of(const Intersector::Member& member) {
  return static_cast<uint32_t>(member.is_boundary ? RayMask::boundary : RayMask::opaque);
}

Bounds3 bounds_of(RTCScene scene) {
  RTCBounds b;
  rtcGetSceneBounds(scene, &b);
  const Bounds3 result{.min = {b.lower_x, b.lower_y, b.lower_z},
                       .max = {b.upper_x, b.upper_y, b.upper_z}};
  return result.is_empty() ? Bounds3{} : result;
}

}  // namespace

void EmbreeScenes::Release::operator()(RTCDevice device) const { rtcReleaseDevice(device); }
void EmbreeScenes::Release::operator()(RTCScene scene) const { rtcReleaseScene(scene); }
void EmbreeScenes::Release::operator()(RTCGeometry geometry) const {
  rtcReleaseGeometry(geometry);
}

EmbreeScenes::EmbreeScenes(std::span<const Intersector::Group> groups,
                           std::span<const Intersector::Instance> instances,
                           const EmbreeCallbacks& callbacks)
    : callbacks_(callbacks), device_(rtcNewDevice(nullptr)) {
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
  rtcCommitScene(world());
  rtcCommitScene(boundaries());
  throw_on_error(device_.get());
  boundary_bounds_ = bounds_of(boundaries());
}

Bounds3 EmbreeScenes::world_bounds() const { return bounds_of(world()); }

EmbreeScenes::Handle<RTCSceneTy> EmbreeScenes::new_scene() const {
  Handle<RTCSceneTy> scene(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  return scene;
}

// Fills `targets`, whose addresses Embree keeps.
EmbreeScenes::Handle<RTCSceneTy> EmbreeScenes::new_scene(const Intersector::Group& group,
                                                         std::vector<TargetShape>& targets,
                                                         bool is_instanced) {
  Handle<RTCSceneTy> scene = new_scene();
  targets.reserve(group.size());
  for (size_t i = 0; i < group.size(); ++i) {
    const bool is_boundary = group[i].is_boundary;
    TargetShape& target = targets.emplace_back(
        *group[i].shape, is_boundary ? 1 : group[i].alpha, hash(scenes_.size(), i));
    const size_t primitives = target.primitive_count();
    if (primitives == 0) continue;
    const Handle<RTCGeometryTy> handle =
        target.mesh() ? new_triangles(target, is_boundary, is_instanced)
                      : new_user_geometry(primitives, is_boundary);
    rtcSetGeometryUserData(handle.get(), &target);
    rtcSetGeometryMask(handle.get(), mask_of(group[i]));
    rtcCommitGeometry(handle.get());
    rtcAttachGeometryByID(scene.get(), handle.get(), static_cast<unsigned>(i));
    if (is_boundary && !is_instanced)
      rtcAttachGeometryByID(boundaries(), handle.get(), static_cast<unsigned>(i));
  }
  throw_on_error(device_.get());
  return scene;
}

EmbreeScenes::Handle<RTCGeometryTy> EmbreeScenes::new_triangles(const TargetShape& target,
                                                                bool is_boundary,
                                                                bool is_instanced) const {
  const TriangleMesh& mesh = *target.mesh();
  Handle<RTCGeometryTy> geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  void* vertices =
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(Vec3), mesh.positions().size());
  throw_on_error(device_.get());
  std::copy(mesh.positions().begin(), mesh.positions().end(), static_cast<Vec3*>(vertices));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles().data(), 0, sizeof(Vec3i),
                             mesh.triangles().size());
  // In the world find() checks the closest hit itself, which costs less than a callback for
  // each; an occlusion test does not tell what it hit.
  const RTCFilterFunctionN filter =
      target.is_translucent() ? callbacks_.filter_translucent : callbacks_.filter;
  rtcSetGeometryOccludedFilterFunction(geometry.get(), filter);
  if (is_boundary)
    rtcSetGeometryIntersectFilterFunction(geometry.get(), callbacks_.filter_boundary);
  else if (is_instanced || target.is_translucent())
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filter);
  return geometry;
}

EmbreeScenes::Handle<RTCGeometryTy> EmbreeScenes::new_user_geometry(
    size_t primitives, bool is_boundary) const {
  Handle<RTCGeometryTy> geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(primitives));
  rtcSetGeometryBoundsFunction(geometry.get(), find_bounds, nullptr);
  rtcSetGeometryIntersectFunction(
      geometry.get(), is_boundary ? callbacks_.intersect_boundary : callbacks_.intersect);
  rtcSetGeometryOccludedFunction(geometry.get(), callbacks_.occlude);
  return geometry;
}

void EmbreeScenes::add_instances(std::span<const Intersector::Group> groups,
                                 std::span<const Intersector::Instance> instances) {
  instances_.first = static_cast<uint32_t>(targets_[0].size());
  for (size_t i = 0; i < instances.size(); ++i) {
    const auto& [group, world_from_group] = instances[i];
    assert(0 < group && group < groups.size());
    const Affine world = Affine(world_from_group).rounded();  // as Embree keeps it
    instances_.maps.push_back({group, world, world.inverse()});
    uint32_t mask = 0;
    for (const Intersector::Member& member : groups[group]) mask |= mask_of(member);
    const Handle<RTCGeometryTy> handle(
        rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(handle.get(), scenes_[group].get());
    rtcSetGeometryTransform(handle.get(), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                            world.floats().data());
    rtcSetGeometryMask(handle.get(), mask);
    rtcCommitGeometry(handle.get());
    const uint32_t id = instances_.first + static_cast<uint32_t>(i);
    rtcAttachGeometryByID(scenes_[0].get(), handle.get(), id);
    if (mask & static_cast<uint32_t>(RayMask::boundary))
      rtcAttachGeometryByID(boundaries(), handle.get(), id);
  }
}

}  // namespace tyndall
