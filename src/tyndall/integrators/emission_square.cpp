// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/emission_square.h"

#include <algorithm>
#include <cmath>

#include "tyndall/geometry/intersector.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

// The local direction of a flat light, on either side if it has two; and back.
Vec3 sample_side(Vec2 u, bool two_sided) {
  if (!two_sided) return sample_cosine_hemisphere(u);
  const bool is_back = u.x >= 0.5f;
  u.x = std::min(is_back ? 2 * u.x - 1 : 2 * u.x, one_minus_epsilon);
  const Vec3 w = sample_cosine_hemisphere(u);
  return {w.x, w.y, is_back ? -w.z : w.z};
}

Vec2 invert_side(Vec3 w, bool two_sided) {
  const Vec2 u = invert_cosine_hemisphere(w);
  return two_sided ? Vec2{0.5f * u.x + (w.z < 0 ? 0.5f : 0.0f), u.y} : u;
}

// A full sphere that is not stretched: where its normals point from, and how far.
bool is_round(const Sphere& sphere) {
  if (!sphere.is_full()) return false;
  const Bounds3 box = sphere.bounds();
  const Vec3 size = box.max - box.min;
  return std::abs(size.x - size.y) <= 1e-4f * size.x &&
         std::abs(size.x - size.z) <= 1e-4f * size.x;
}

// Of cones: surfaces that bound what matters lie a little beyond it.
constexpr float margin = 1.1f;

// One minus the cosine of the half-angle of the cone in which rays from within `radius` of
// p go that meet the sphere around the box; two, all directions, from near it.
float width_towards(const Bounds3& box, Vec3 p, float radius) {
  if (box.is_empty()) return 2;
  const float sine = (margin * box.radius() + radius) / length(box.center() - p);
  if (!(sine > 0 && sine < 0.5f)) return 2;
  return sqr(sine) / (1 + safe_sqrt(1 - sqr(sine)));
}

// The normal of all of a shape; empty if it varies.
std::optional<Vec3> common_normal(const Shape& shape) {
  constexpr int probes = 16;
  const Vec3 n = sample_area(shape, {0.5f, 0.5f}).point.ng;
  for (int i = 0; i < probes; ++i) {
    const Vec2 u{(static_cast<float>(i) + 0.5f) / probes,
                 std::fmod(0.618034f * static_cast<float>(i + 1), 1.0f)};
    if (!(dot(sample_area(shape, u).point.ng, n) > 1 - 1e-5f)) return std::nullopt;
  }
  return n;
}

}  // namespace

std::optional<EmissionSquare> EmissionSquare::of(const Light& light, const Bounds3& box,
                                                 const Bounds3& scene_bounds) {
  const LightVariant& variant = light.variant();
  if (const auto* distant = std::get_if<DistantLight>(&variant)) {
    if (box.is_empty()) return std::nullopt;
    const float radius = box.radius();
    EmissionSquare square(light, Kind::parallel, Frame::from_z(distant->wi),
                          sqr(2 * radius));
    const float beyond =
        2 * scene_bounds.radius() + length(scene_bounds.center() - box.center());
    square.center_ = box.center() + distant->wi * beyond;
    square.radius_ = radius;
    return square;
  }
  const Frame upright = Frame::from_z({0, 0, 1});
  if (const auto* point = std::get_if<PointLight>(&variant))
    return EmissionSquare(light, Kind::point, upright, 0).aimed(box, point->p, 0);
  if (const auto* spot = std::get_if<SpotLight>(&variant)) {
    EmissionSquare square(light, Kind::spot, Frame::from_z(spot->axis), 0);
    square.width_ = 1 - spot->cos_total;
    return square.aimed(box, spot->p, 0);
  }
  const auto* emitter = std::get_if<AreaLight>(&variant);
  if (!emitter) return std::nullopt;
  const float a = area(*emitter->shape);
  const auto* sphere = std::get_if<Sphere>(emitter->shape);
  if (sphere && is_round(*sphere) && !emitter->two_sided) {
    const Bounds3 ball = sphere->bounds();
    return EmissionSquare(light, Kind::sphere, upright, a)
        .aimed(box, ball.center(), 0.5f * (ball.max.x - ball.min.x));
  }
  if (!(a > 0)) return EmissionSquare(light, Kind::bent, upright, a);
  if (const std::optional<Vec3> n = common_normal(*emitter->shape))
    return EmissionSquare(light, Kind::flat, Frame::from_z(*n), a);
  return EmissionSquare(light, Kind::bent, upright, a);
}

// Far lights shine on what matters through a narrow cone; what else they do is left to
// walks.
EmissionSquare EmissionSquare::aimed(const Bounds3& box, Vec3 p, float radius) const {
  const float width = width_towards(box, p, radius);
  if (!(width < width_)) return *this;
  EmissionSquare square = *this;
  square.width_ = width;
  square.frame_ = Frame::from_z(normalize(box.center() - p));
  return square;
}

const AreaLight& EmissionSquare::area_light() const {
  return std::get<AreaLight>(light_->variant());
}

EmittedRay EmissionSquare::emit(Vec2 direction, Vec2 point) const {
  if (const auto* light = std::get_if<PointLight>(&light_->variant()))
    return {{light->p, direction_in_cone(direction)}, light->I, uniform_cone_pdf(width_)};
  if (const auto* light = std::get_if<SpotLight>(&light_->variant())) {
    const Vec3 w = direction_in_cone(direction);
    return {{light->p, w}, light->intensity(w), uniform_cone_pdf(width_)};
  }
  if (kind_ == Kind::parallel) return emit_parallel(direction);
  return kind_ == Kind::sphere ? emit_sphere(direction, point)
                               : emit_area(direction, point);
}

EmittedRay EmissionSquare::emit_parallel(Vec2 position) const {
  const auto& light = std::get<DistantLight>(light_->variant());
  const Vec3 across = frame_.x * (2 * position.x - 1) + frame_.y * (2 * position.y - 1);
  return {{center_ + across * radius_, -light.wi}, light.L, 1 / area_};
}

// Where it is across parallel light: in the unit square if the box's square reaches it.
Vec2 EmissionSquare::position_of(Vec3 p) const {
  const Vec3 q = frame_.to_local(p - center_);
  return {0.5f + 0.5f * q.x / radius_, 0.5f + 0.5f * q.y / radius_};
}

Vec3 EmissionSquare::direction_in_cone(Vec2 u) const {
  return frame_.to_world(sample_uniform_cone(u, width_));
}

// The direction first, uniform; then a point whose normal is about it by the cosine: the
// same density as by area and cosine.
EmittedRay EmissionSquare::emit_sphere(Vec2 direction, Vec2 point) const {
  const auto& sphere = std::get<Sphere>(*area_light().shape);
  const Bounds3 box = sphere.bounds();
  const Vec3 w = direction_in_cone(direction);
  const Vec3 local = sample_cosine_hemisphere(point);
  const Vec3 ng = Frame::from_z(w).to_world(local);
  const float r = 0.5f * (box.max.x - box.min.x);
  const Vec3 p = box.center() + ng * (sphere.flip_normals ? -r : r);
  return {{offset_origin(p, ng, w), w},
          area_light().L * local.z,
          uniform_cone_pdf(width_) * 4 * local.z / area_,
          {.p = p, .ng = ng, .ns = ng, .uv = {}}};
}

EmittedRay EmissionSquare::emit_area(Vec2 direction, Vec2 point) const {
  const AreaLight& light = area_light();
  const ShapeSample s = sample_area(*light.shape, point);
  const Vec3 local = sample_side(direction, light.two_sided);
  const Frame frame = kind_ == Kind::flat ? frame_ : Frame::from_z(s.point.ng);
  const Vec3 w = frame.to_world(local);
  const float cosine = magnitude(local.z), sides = light.two_sided ? 2.0f : 1.0f;
  return {{offset_origin(s.point.p, s.point.ng, w), w},
          light.L * cosine,
          s.pdf_area * cosine * inv_pi / sides,
          s.point};
}

Vec2 EmissionSquare::invert(Vec3 w, Vec3 p) const {
  switch (kind_) {
    case Kind::parallel:
      return position_of(p);
    case Kind::point:
    case Kind::spot:
    case Kind::sphere:
      return invert_uniform_cone(frame_.to_local(w), width_);
    case Kind::flat:
      return invert_side(frame_.to_local(w), area_light().two_sided);
    case Kind::bent:
      break;
  }
  return {0.5f, 0.5f};
}

float EmissionSquare::density(Vec3 p, Vec3 to_light, float distance) const {
  // All ways to find the point have the cosine at the surface and, for area lights, the one
  // at the light over the squared distance in common.
  if (kind_ == Kind::parallel) {
    const Vec2 u = position_of(p);
    const bool is_in_square = u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1;
    return is_in_square ? 1 / area_ : 0;
  }
  if (kind_ == Kind::flat || kind_ == Kind::bent)
    return area_ > 0 ? inv_pi / (area_ * (area_light().two_sided ? 2.0f : 1.0f)) : 0;
  if (!(one_minus_cos(frame_.to_local(-to_light)) <= width_)) return 0;
  const float pdf = uniform_cone_pdf(width_);
  return kind_ == Kind::sphere ? 4 * pdf / area_ : pdf / sqr(distance);
}

}  // namespace tyndall
