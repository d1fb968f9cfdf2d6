// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/small_vector.hpp>
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

/// A boundary that a ray goes through.
struct SurfaceCrossing {
  float t;  ///< distance along the ray [scene units]
  const Surface* surface;
  bool goes_out;  ///< to the side of the geometric normal
};

/// A surface that a ray meets, before its point is computed.
struct FoundSurface {
  RayHit hit;
  const Surface* surface;  ///< material, media, emission
};

/// A stretch of a ray in one medium.
struct MediumSpan {
  float t_min, t_max;    ///< along the ray [scene units]
  const Medium* medium;  ///< null in empty space
};

/// In order and without gaps, from zero on; not empty.
using MediumSpans = boost::container::small_vector<MediumSpan, 4>;
using SurfaceCrossings = boost::container::small_vector<SurfaceCrossing, 4>;

/// An immutable scene, ready to trace. Safe to use from all threads.
class Scene {
 public:
  /// Takes the description over. Throws std::runtime_error if memory runs out.
  explicit Scene(SceneDescription description);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  const PerspectiveCamera& camera() const;
  /// What surrounds the camera, found by tracing to the surfaces around it that state their
  /// media; null in empty space.
  const Medium* camera_medium() const;
  /// The indices of the media in it.
  const std::vector<int>& camera_media() const;
  /// What surrounds a point, found in the same way; where nothing tells, what the
  /// description says of the camera.
  const Medium* surrounding_medium(Vec3 p) const;
  /// What light from infinitely far in the unit direction `w` comes through.
  const Medium* medium_at_infinity(Vec3 w) const;
  const std::vector<Light>& lights() const;
  Bounds3 bounds() const;

  /// The first surface in (0, t_max), opaque or boundary.
  std::optional<SurfaceHit> intersect(const Ray& ray, float t_max) const;
  /// The same in two steps, for callers that may not go there. `ray` is the one that found.
  std::optional<FoundSurface> find(const Ray& ray, float t_max) const;
  SurfaceHit resolve(const Ray& ray, const FoundSurface& found) const;
  /// The first surface in (0, t_max) that is not only a boundary between media.
  std::optional<SurfaceHit> intersect_opaque(const Ray& ray, float t_max) const;
  /// As intersect_opaque(); writes the boundaries in front of it to `crossings`, in order.
  std::optional<SurfaceHit> intersect_through(const Ray& ray, float t_max,
                                              SurfaceCrossings& crossings) const;
  /// The first surface that is not only a boundary; writes the media before it to `spans`,
  /// for a ray that starts in `medium`, which becomes the medium at the end.
  std::optional<FoundSurface> trace(const Ray& ray, float t_max, const Medium*& medium,
                                    MediumSpans& spans) const;
  /// The media along (0, t_max) of a ray that starts in `medium` and that no surface stops.
  /// Returns the medium at the end.
  const Medium* media_along(const Ray& ray, float t_max, const Medium* medium,
                            MediumSpans& spans) const;
  /// Whether an opaque surface lies in (0, t_max).
  bool is_occluded(const Ray& ray, float t_max) const;
  bool has_boundaries() const;
  /// The medium that fills the scene, boundaries there being none; null otherwise.
  const Medium* filling_medium() const;

  /// The media behind a surface for a ray that crosses it towards `d`, coming from
  /// `current`; see MediumSets.
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
