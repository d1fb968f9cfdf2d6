// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/light_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/math/constants.h"
#include "tyndall/math/vector_clones.h"

namespace tyndall {

namespace {

constexpr float tiny = 1e-30f;

// In [0, 1); NaN becomes 0.
[[gnu::always_inline]] inline float to_unit(float x) {
  x = x > 0 ? x : 0.0f;
  return x < one_minus_epsilon ? x : one_minus_epsilon;
}

[[gnu::always_inline]] inline float sign(float x) { return std::copysign(1.0f, x); }

Vec3 octahedral_direction(Vec2 uv) {
  const float x = 2 * uv.x - 1, y = 2 * uv.y - 1;
  const float z = 1 - std::abs(x) - std::abs(y);
  const Vec3 w = z >= 0 ? Vec3{x, y, z}
                        : Vec3{(1 - std::abs(y)) * sign(x), (1 - std::abs(x)) * sign(y), z};
  return normalize(w);
}

// The three projections of a point in the view's frame. Written without branches, and
// inlined whatever the compiler thinks, so that the loop over a batch is vectorized.

[[gnu::always_inline]] inline ViewPoint project_sphere(float x, float y, float z) {
  const float distance = std::sqrt(x * x + y * y + z * z);
  const float inverse = 1 / std::max(std::abs(x) + std::abs(y) + std::abs(z), tiny);
  const float a = x * inverse, b = y * inverse;
  const float folded_a = (1 - std::abs(b)) * sign(a),
              folded_b = (1 - std::abs(a)) * sign(b);
  const float u = z < 0 ? folded_a : a, v = z < 0 ? folded_b : b;
  return {{to_unit(0.5f * u + 0.5f), to_unit(0.5f * v + 0.5f)}, distance};
}

[[gnu::always_inline]] inline ViewPoint project_cone(float x, float y, float z,
                                                     float tangent) {
  const float distance = std::sqrt(x * x + y * y + z * z);
  const float inverse = 1 / std::max(z * tangent, tiny);
  const float a = x * inverse, b = y * inverse;
  const float reach = z > 0 ? std::max(std::abs(a), std::abs(b)) : 2.0f;
  const bool inside = reach <= 1;  // false for NaN
  const float u = to_unit(0.5f * a + 0.5f), v = to_unit(0.5f * b + 0.5f);
  return {{inside ? u : -1.0f, inside ? v : -1.0f}, distance};
}

[[gnu::always_inline]] inline ViewPoint project_parallel(float x, float y, float z,
                                                         float radius) {
  const float inverse = 0.5f / radius;
  return {{to_unit(x * inverse + 0.5f), to_unit(y * inverse + 0.5f)}, radius - z};
}

template <typename Project>
[[gnu::always_inline]] inline void project_all(Vec3 o, Vec3 d, std::span<const float> t,
                                               ViewBatch& out, Project project) {
  std::array<float, ViewBatch::capacity> distances;  // of its own: `t` may be part of `out`
  std::copy(t.begin(), t.end(), distances.begin());
  for (size_t i = 0; i < t.size(); ++i) {
    const float s = distances[i];
    const ViewPoint q = project(o.x + s * d.x, o.y + s * d.y, o.z + s * d.z);
    out.u[i] = q.uv.x;
    out.v[i] = q.uv.y;
    out.distance[i] = q.distance;
  }
}

}  // namespace

LightView LightView::around(Vec3 p) {
  return {Kind::sphere, Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, p, 1};
}

LightView LightView::cone(Vec3 p, Vec3 axis, float cos_total) {
  if (!(cos_total >= 0.25f)) return around(p);
  // A little wider, so that the rim is inside.
  const float tangent = 1.001f * safe_sqrt(1 - sqr(cos_total)) / cos_total + 1e-6f;
  return {Kind::cone, Frame::from_z(axis), p, tangent};
}

LightView LightView::parallel(Vec3 wi, const Bounds3& scene) {
  const float radius = std::max(scene.radius() * 1.0001f, tiny);
  return {Kind::parallel, Frame::from_z(wi), scene.is_empty() ? Vec3{} : scene.center(),
          radius};
}

ViewPoint LightView::project(Vec3 p) const {
  const Vec3 q = frame_.to_local(p - origin_);
  switch (kind_) {
    case Kind::sphere:
      return project_sphere(q.x, q.y, q.z);
    case Kind::cone:
      return project_cone(q.x, q.y, q.z, scale_);
    default:
      return project_parallel(q.x, q.y, q.z, scale_);
  }
}

TYNDALL_VECTOR_CLONES
void LightView::project(const Ray& ray, std::span<const float> t, ViewBatch& out) const {
  assert(t.size() <= ViewBatch::capacity);
  const Vec3 o = frame_.to_local(ray.o - origin_), d = frame_.to_local(ray.d);
  const float scale = scale_;
  switch (kind_) {
    case Kind::sphere:
      return project_all(o, d, t, out,
                         [](float x, float y, float z) { return project_sphere(x, y, z); });
    case Kind::cone:
      return project_all(o, d, t, out, [scale](float x, float y, float z) {
        return project_cone(x, y, z, scale);
      });
    default:
      return project_all(o, d, t, out, [scale](float x, float y, float z) {
        return project_parallel(x, y, z, scale);
      });
  }
}

Ray LightView::ray(Vec2 uv) const {
  const float a = 2 * uv.x - 1, b = 2 * uv.y - 1;
  switch (kind_) {
    case Kind::sphere:
      return {origin_, frame_.to_world(octahedral_direction(uv))};
    case Kind::cone:
      return {origin_, frame_.to_world(normalize(Vec3{a * scale_, b * scale_, 1}))};
    default:
      return {origin_ + frame_.to_world(Vec3{a, b, 1} * scale_), -frame_.z};
  }
}

float LightView::extent() const {
  switch (kind_) {
    case Kind::sphere:
      return std::sqrt(4 * pi);  // square root of the solid angle
    case Kind::cone:
      return 2 * std::atan(scale_);
    default:
      return 2 * scale_;
  }
}

void LightView::write(ByteWriter& out) const {
  out.write(static_cast<uint32_t>(kind_));
  for (const Vec3 v : {frame_.x, frame_.y, frame_.z, origin_}) out.write(v);
  out.write(scale_);
}

LightView LightView::read(ByteReader& in) {
  const auto kind = in.read_as<uint32_t>();
  LightView view = around({});
  view.kind_ = static_cast<Kind>(kind);
  for (Vec3* v : {&view.frame_.x, &view.frame_.y, &view.frame_.z, &view.origin_})
    in.read(*v);
  in.read(view.scale_);
  const bool is_valid = kind <= static_cast<uint32_t>(Kind::parallel) && view.scale_ > 0;
  if (!in.failed() && is_valid) return view;
  in.fail();
  return around({});
}

}  // namespace tyndall
