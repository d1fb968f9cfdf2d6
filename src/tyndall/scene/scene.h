// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/geometry/intersector.h"
#include "tyndall/scene/light_choice.h"
#include "tyndall/scene/scene_description.h"

namespace tyndall {

/// What a ray meets: a surface point with everything that stands there.
struct SurfaceHit {
  float t;  ///< distance along the ray [scene units]
  SurfacePoint point;
  const Surface* surface;  ///< material, media, emission
  const Light* light;      ///< the area light of the surface, or null
  size_t light_index;      ///< of `light` in Scene::lights()
};

/// A surface that a ray meets, before its point is computed.
struct FoundSurface {
  RayHit hit;
  const Surface* surface;  ///< material, media, emission
};

/// An immutable scene, ready to trace. Safe to use from all threads.
class Scene {
 public:
  /// Takes the description over. Throws std::runtime_error if memory runs out.
  explicit Scene(SceneDescription description);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  const PerspectiveCamera& camera() const;
  /// The medium that surrounds the camera, found by tracing to the nearest surfaces that
  /// state their media; null in empty space.
  const Medium* camera_medium() const;
  const std::vector<Light>& lights() const;
  Bounds3 bounds() const;

  /// The first surface in (0, t_max), opaque or boundary.
  std::optional<SurfaceHit> intersect(const Ray& ray, float t_max) const;
  /// The same in two steps, for callers that may not go there. `ray` is the one that found.
  std::optional<FoundSurface> find(const Ray& ray, float t_max) const;
  SurfaceHit resolve(const Ray& ray, const FoundSurface& found) const;
  /// The first surface in (0, t_max) that is not only a boundary between media.
  std::optional<SurfaceHit> intersect_opaque(const Ray& ray, float t_max) const;
  /// The first boundary between media in (0, t_max).
  std::optional<SurfaceHit> intersect_boundary(const Ray& ray, float t_max) const;
  /// Whether an opaque surface lies in (0, t_max).
  bool is_occluded(const Ray& ray, float t_max) const;
  bool has_boundaries() const;

  /// The medium behind a surface for a ray that crosses it towards `d`, coming from
  /// `current`.
  const Medium* medium_across(const SurfaceHit& hit, Vec3 d, const Medium* current) const;

  /// Draws a light in proportion to its power. Empty if there are none.
  std::optional<SelectedLight> select_light(float u) const;
  float light_probability(size_t index) const;
  /// Radiance from all environments against direction w.
  Rgb environment(Vec3 w) const;
  /// Indices of the lights that environment() sums.
  const std::vector<size_t>& environments() const;
  /// The light in lights() that all glowing media are; empty if none has bounds.
  std::optional<size_t> volume_light() const;
  /// Whether any medium glows.
  bool has_glow() const;
  /// What the scene was built from.
  const SceneDescription& description() const;

  /// Things worth telling the user: lights and cameras in doubtful places, open boundaries.
  const std::vector<std::string>& remarks() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tyndall
