// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "tyndall/geometry/ray.h"
#include "tyndall/guiding/byte_stream.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/frame.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// A point as a light sees it.
struct ViewPoint {
  Vec2 uv;         ///< which way: in [0, 1)^2; both negative if out of the light's cone
  float distance;  ///< how far [scene units]
};

/// Many of them, as a structure of arrays.
struct ViewBatch {
  static constexpr size_t capacity = 64;

  alignas(32) std::array<float, capacity> u, v, distance;
};

/// The coordinates of a light: which way, and how far. Where occlusion is a function of
/// these two, as for a point light, learning it in them is sharp at any distance.
class LightView {
 public:
  /// All directions around a point, by the octahedral map [Clarberg08].
  static LightView around(Vec3 p);
  /// The directions within an angle of `axis` (unit), by perspective projection; all
  /// directions if the cosine of that angle is below 0.25.
  static LightView cone(Vec3 p, Vec3 axis, float cos_total);
  /// Parallel light that comes from direction `wi` (unit), across a scene.
  static LightView parallel(Vec3 wi, const Bounds3& scene);

  ViewPoint project(Vec3 p) const;
  /// The points ray.at(t[i]). Precondition: at most ViewBatch::capacity.
  void project(const Ray& ray, std::span<const float> t, ViewBatch& out) const;
  /// The ray along which uv is constant and its `t` is the distance; for lights at infinity
  /// it starts beside the scene.
  Ray ray(Vec2 uv) const;

  /// About what one unit of uv spans: an angle [rad], or a length for parallel light.
  float extent() const;
  bool is_parallel() const { return kind_ == Kind::parallel; }

  void write(ByteWriter& out) const;
  /// A view of a point at the origin, and the reader failed, if what it reads is no view.
  static LightView read(ByteReader& in);

 private:
  enum class Kind { sphere, cone, parallel };

  LightView(Kind kind, const Frame& frame, Vec3 origin, float scale)
      : kind_(kind), frame_(frame), origin_(origin), scale_(scale) {}

  Kind kind_;
  Frame frame_;  // z along the axis of a cone, towards a light at infinity
  Vec3 origin_;  // the light; for parallel light the scene's center
  float scale_;  // of the cone: tangent; of parallel light: radius of the scene
};

}  // namespace tyndall
