// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/lit_surface.h"

#include <algorithm>

#include "tyndall/math/frame.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

struct Emitted {
  Ray ray;
  Rgb emission;
  float pdf;
  SurfacePoint on{};  // of area lights
};

Emitted emit(const PointLight& light, Vec2 /*u_point*/, Vec2 u) {
  return {{light.p, sample_uniform_sphere(u)}, light.I, inv_4pi};
}

float cone_pdf(const SpotLight& light) { return inv_pi / (2 * (1 - light.cos_total)); }

Emitted emit(const SpotLight& light, Vec2 /*u_point*/, Vec2 u) {
  const float cos_theta = 1 - u.x * (1 - light.cos_total);
  const Vec3 w =
      Frame::from_z(light.axis).to_world(spherical_direction(cos_theta, 2 * pi * u.y));
  return {{light.p, w}, light.intensity(w), cone_pdf(light)};
}

Emitted emit(const AreaLight& light, Vec2 u_point, Vec2 u) {
  const ShapeSample s = sample_area(*light.shape, u_point);
  float side = 1;
  if (light.two_sided) {
    side = u.x < 0.5f ? 1.0f : -1.0f;
    u.x = std::min(u.x < 0.5f ? 2 * u.x : 2 * u.x - 1, one_minus_epsilon);
  }
  const Vec3 local = sample_cosine_hemisphere(u);
  const Vec3 w = Frame::from_z(s.point.ng * side).to_world(local);
  const float sides = light.two_sided ? 2.0f : 1.0f;
  return {{offset_origin(s.point.p, s.point.ng, w), w},
          light.L * local.z,
          s.pdf_area * local.z * inv_pi / sides,
          s.point};
}

template <typename T>
Emitted emit(const T& /*at_infinity*/, Vec2, Vec2) {
  return {};
}

}  // namespace

LitSurfaceSampling::LitSurfaceSampling(const Scene& scene) : scene_(&scene) {
  std::vector<float> power;
  for (const Light& light : scene.lights()) {
    power.push_back(light.is_infinite() ? 0
                                        : luminance(light.power(scene.bounds().radius())));
    const auto* area_light = std::get_if<AreaLight>(&light.variant());
    area_.push_back(area_light ? area(*area_light->shape) : 0);
  }
  power_ = DiscreteDistribution(power);
}

bool LitSurfaceSampling::finds(const Surface& surface) {
  const auto* diffuse = std::get_if<DiffuseBsdf>(&surface.material);
  return diffuse && !is_black(diffuse->reflectance);
}

float LitSurfaceSampling::probability(size_t light) const {
  return scene_->lights()[light].is_infinite() ? 0 : power_.probability(light);
}

std::optional<LitPoint> LitSurfaceSampling::sample(float u_light, Vec2 u_point,
                                                   Vec2 u_direction) const {
  const DiscreteSample chosen = power_.sample(u_light);
  const Light& light = scene_->lights()[chosen.index];
  const Emitted emitted = std::visit(
      [&](const auto& l) { return emit(l, u_point, u_direction); }, light.variant());
  if (!(emitted.pdf > 0) || is_black(emitted.emission)) return std::nullopt;
  const std::optional<SurfaceHit> hit = scene_->intersect_opaque(emitted.ray, infinity);
  if (!hit || !finds(*hit->surface)) return std::nullopt;
  return LitPoint{.hit = *hit,
                  .to_light = -emitted.ray.d,
                  .distance = hit->t,
                  .emission = emitted.emission,
                  .pdf = chosen.probability * emitted.pdf,
                  .light = chosen.index,
                  .on_light = emitted.on};
}

float LitSurfaceSampling::density(size_t light, Vec3 to_light, float distance) const {
  // Both densities have the cosine at the surface and, for area lights, the one at the
  // light over the squared distance in common.
  const LightVariant& variant = scene_->lights()[light].variant();
  const float p = probability(light);
  if (std::holds_alternative<PointLight>(variant)) return p * inv_4pi / sqr(distance);
  if (const auto* spot = std::get_if<SpotLight>(&variant)) {
    const bool is_in_cone = dot(-to_light, spot->axis) >= spot->cos_total;
    return is_in_cone ? p * cone_pdf(*spot) / sqr(distance) : 0;
  }
  if (const auto* area_light = std::get_if<AreaLight>(&variant))
    return p * inv_pi / (area_[light] * (area_light->two_sided ? 2.0f : 1.0f));
  return 0;
}

}  // namespace tyndall
