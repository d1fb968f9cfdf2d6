// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tyndall/geometry/intersector.h"
#include "tyndall/geometry/scene_hit.h"
#include "tyndall/geometry/target_shape.h"
#include "tyndall/math/bounds.h"

// Embree's own types, which its headers define.
struct RTCDeviceTy;
struct RTCGeometryTy;
struct RTCSceneTy;
struct RTCFilterFunctionNArguments;
struct RTCIntersectFunctionNArguments;
struct RTCOccludedFunctionNArguments;

namespace tyndall {

/// What Embree calls on the way of a ray. The user pointer of its geometries is a
/// TargetShape.
struct EmbreeCallbacks {
  using Filter = void(const RTCFilterFunctionNArguments* args);
  using Intersect = void(const RTCIntersectFunctionNArguments* args);
  using Occlude = void(const RTCOccludedFunctionNArguments* args);

  Filter *filter, *filter_translucent, *filter_boundary;  ///< hits of triangles
  Intersect *intersect, *intersect_boundary;              ///< other shapes
  Occlude* occlude;
};

/// The instances of groups.
struct InstanceTable {
  static constexpr uint32_t none = UINT32_MAX;

  std::vector<InstanceMaps> maps;  ///< in the order of their geometry indices
  uint32_t first = 0;              ///< geometry index of the first

  /// Null in the world, whose `id` is none.
  const InstanceMaps* of(uint32_t id) const {
    return id == none ? nullptr : &maps[id - first];
  }
};

/// The shapes of an Intersector as Embree keeps them, ready for rays.
class EmbreeScenes {
 public:
  /// As those of Intersector.
  EmbreeScenes(std::span<const Intersector::Group> groups,
               std::span<const Intersector::Instance> instances,
               const EmbreeCallbacks& callbacks);

  RTCSceneTy* world() const { return scenes_[0].get(); }
  Bounds3 world_bounds() const;
  /// The boundaries of the world once more: rays for transmittance need not wade through
  /// the rest, and see at once when there are no more.
  RTCSceneTy* boundaries() const { return boundaries_.get(); }
  const Bounds3& boundary_bounds() const { return boundary_bounds_; }

  const TargetShape& target(uint32_t group, uint32_t shape) const {
    return targets_[group][shape];
  }
  const InstanceTable& instances() const { return instances_; }

 private:
  struct Release {
    void operator()(RTCDeviceTy* device) const;
    void operator()(RTCSceneTy* scene) const;
    void operator()(RTCGeometryTy* geometry) const;
  };
  template <typename T>
  using Handle = std::unique_ptr<T, Release>;

  Handle<RTCSceneTy> new_scene() const;
  Handle<RTCSceneTy> new_scene(const Intersector::Group& group,
                               std::vector<TargetShape>& targets, bool is_instanced);
  Handle<RTCGeometryTy> new_triangles(const TargetShape& target, bool is_boundary,
                                      bool is_instanced) const;
  Handle<RTCGeometryTy> new_user_geometry(size_t primitives, bool is_boundary) const;
  void add_instances(std::span<const Intersector::Group> groups,
                     std::span<const Intersector::Instance> instances);

  EmbreeCallbacks callbacks_;
  Handle<RTCDeviceTy> device_;
  std::vector<std::vector<TargetShape>> targets_;  // by group and shape
  std::vector<Handle<RTCSceneTy>> scenes_;         // by group
  Handle<RTCSceneTy> boundaries_;
  Bounds3 boundary_bounds_;
  InstanceTable instances_;
};

}  // namespace tyndall
