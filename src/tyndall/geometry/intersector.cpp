// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/intersector.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "tyndall/geometry/embree_scenes.h"

namespace tyndall {
namespace {

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

// Whether a ray that starts outside the box goes away from it. Exact: it misses then.
bool goes_away_from(const Bounds3& box, const Ray& ray) {
  for (int i = 0; i < 3; ++i)
    if ((ray.o[i] > box.max[i] && ray.d[i] >= 0) ||
        (ray.o[i] < box.min[i] && ray.d[i] <= 0))
      return true;
  return false;
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

RayContext new_context(const EmbreeScenes& scenes, const Ray& ray, float t_max,
                       Crossings* crossings) {
  RayContext context;
  rtcInitIntersectContext(&context.embree);
  context.world_ray = &ray;
  context.t_max = t_max;
  context.instances = &scenes.instances();
  context.crossings = crossings;
  return context;
}

// Empty if the hit is of a triangle that the ray starts from or ends on.
std::optional<RayHit> finish_hit(const EmbreeScenes& scenes, const RayContext& context,
                                 const RTCRayHit& query) {
  const auto& [ray, hit] = query;
  const InstanceMaps* instance = scenes.instances().of(hit.instID[0]);
  RayHit result{.t = ray.tfar,
                .group = instance ? instance->group : 0,
                .shape = hit.geomID,
                .primitive = hit.primID,
                .instance = hit.instID[0],
                .uv = {hit.u, hit.v}};
  const TargetShape& target = scenes.target(result.group, hit.geomID);
  if (!target.mesh()) return result;
  const PreciseRay precise = precise_ray(*context.world_ray, instance);
  if ((instance || may_be_at_end(target, ray, hit, context.t_max)) &&
      !target.is_between_ends(hit.primID, precise, context.t_max))
    return std::nullopt;
  result.t =
      static_cast<float>(plane_distance(target.mesh()->triangle(hit.primID), precise));
  return result;
}

// Boundaries stop the ray unless `crossings` is given.
std::optional<RayHit> find_in(const EmbreeScenes& scenes, const Ray& ray, float t_max,
                              RayMask mask, Crossings* crossings) {
  if (!can_hit(ray, t_max)) return std::nullopt;
  const bool boundaries_only = mask == RayMask::boundary;
  if (boundaries_only && goes_away_from(scenes.boundary_bounds(), ray)) return std::nullopt;
  const RTCScene scene = boundaries_only ? scenes.boundaries() : scenes.world();
  RayContext context = new_context(scenes, ray, t_max, crossings);
  RTCRayHit query{.ray = to_embree(ray, t_max, mask), .hit = no_hit()};
  for (;;) {
    rtcIntersect1(scene, &context.embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    if (auto hit = finish_hit(scenes, context, query)) return hit;
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

}  // namespace

Intersector::Intersector(std::span<const Group> groups,
                         std::span<const Instance> instances) try
    : scenes_(std::make_unique<EmbreeScenes>(
          groups, instances,
          EmbreeCallbacks{.filter = drop_hit_of_ends,
                          .filter_translucent = drop_hit_of_translucent,
                          .filter_boundary = filter_boundary,
                          .intersect = intersect_user_geometry,
                          .intersect_boundary = intersect_curved_boundary,
                          .occlude = occlude_user_geometry})) {
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
  return find_in(*scenes_, ray, t_max, mask, nullptr);
}

std::optional<RayHit> Intersector::find_through(const Ray& ray, float t_max, RayMask mask,
                                                Crossings& crossings) const {
  crossings.clear();
  const std::optional<RayHit> hit = find_in(*scenes_, ray, t_max, mask, &crossings);
  if (hit) drop_beyond(crossings, hit->t);
  std::ranges::sort(crossings, {}, &Crossing::t);
  return hit;
}

SceneHit Intersector::resolve(const Ray& ray, const RayHit& hit) const {
  const InstanceMaps* instance = scenes_->instances().of(hit.instance);
  return reconstruct(scenes_->target(hit.group, hit.shape), hit, precise_ray(ray, instance),
                     instance);
}

bool Intersector::is_occluded(const Ray& ray, float t_max, RayMask mask) const {
  if (!can_hit(ray, t_max)) return false;
  RayContext context = new_context(*scenes_, ray, t_max, nullptr);
  RTCRay query = to_embree(ray, t_max, mask);
  rtcOccluded1(scenes_->world(), &context.embree, &query);
  return query.tfar < 0;
}

Bounds3 Intersector::bounds() const { return scenes_->world_bounds(); }

}  // namespace tyndall
