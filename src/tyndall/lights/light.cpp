// SPDX-License-Identifier: Apache-2.0
#include "tyndall/lights/light.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/geometry/intersector.h"
#include "tyndall/lights/octahedral.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

// Of the coordinates of who looks: so far before a point light that lies on a surface the
// roundings of both may place that surface.
constexpr float on_surface = 1e-6f;

/// Cubic step from 0 at `a` to 1 at `b`; a jump if they are equal.
float smooth_step(float x, float a, float b) {
  if (!(a < b)) return x < b ? 0 : 1;
  const float t = std::clamp((x - a) / (b - a), 0.0f, 1.0f);
  return sqr(t) * (3 - 2 * t);
}

size_t pixel_index(const ImageEnvironment& light, Vec2 p) {
  const auto cell = [&](float x) {
    const float scaled = std::max(x, 0.0f) * static_cast<float>(light.resolution);
    return static_cast<size_t>(std::min(static_cast<int>(scaled), light.resolution - 1));
  };
  return cell(p.y) * static_cast<size_t>(light.resolution) + cell(p.x);
}

/// Empty if nothing arrives, or nothing that a float can hold.
std::optional<LightSample> if_it_shines(const LightSample& sample) {
  if (is_black(sample.L) || !is_finite(sample.L)) return std::nullopt;
  return sample;
}

/// Light from a point at `from_p` whose intensity towards p is asked of `intensity`.
template <typename Intensity>
std::optional<LightSample> sample_from_point(Vec3 light_p, Vec3 p, Intensity intensity) {
  const Vec3 d = light_p - p;
  const float distance = length(d);
  if (!(distance > 0)) return std::nullopt;
  const Vec3 wi = d / distance;
  const float inv = 1 / distance;
  return if_it_shines({.wi = wi,
                       .distance = distance,
                       .L = intensity(-wi) * inv * inv,
                       .pdf = 1,
                       .is_delta = true,
                       .rounded_end = on_surface * max_component(abs(p))});
}

std::optional<LightSample> draw(const PointLight& light, Vec3 p, Vec2) {
  return sample_from_point(light.p, p, [&](Vec3) { return light.I; });
}

std::optional<LightSample> draw(const SpotLight& light, Vec3 p, Vec2) {
  return sample_from_point(light.p, p, [&](Vec3 w) { return light.intensity(w); });
}

std::optional<LightSample> draw(const DistantLight& light, Vec3, Vec2) {
  return if_it_shines({light.wi, infinity, light.L, 1, true});
}

std::optional<LightSample> draw(const ConstantEnvironment& light, Vec3, Vec2 u) {
  return if_it_shines(
      {sample_uniform_sphere(u), infinity, light.L, uniform_sphere_pdf(), false});
}

std::optional<LightSample> draw(const ImageEnvironment& light, Vec3, Vec2 u) {
  const PiecewiseSample2D s = light.distribution.sample(u);
  const Vec3 wi = normalize(light.world_from_light.vector(octahedral_direction(s.p)));
  return if_it_shines({wi, infinity, light.lookup(s.p), s.pdf * inv_4pi, false});
}

std::optional<LightSample> draw(const AreaLight& light, Vec3 p, Vec2 u) {
  const std::optional<ShapeDirectionSample> s = sample_direction(*light.shape, p, u);
  if (!s || !(s->pdf > 0)) return std::nullopt;
  const Vec3 d = s->point.p - p;
  const float distance = length(d);
  if (!(distance > 0)) return std::nullopt;
  const Vec3 wi = d / distance;
  return if_it_shines({.wi = wi,
                       .distance = distance,
                       .L = light.Le(s->point, -wi),
                       .pdf = s->pdf,
                       .is_delta = false,
                       .rounded_end = rounded_end(p, s->point.p, s->point.ng)});
}

std::optional<LightSample> draw(const HiddenAreaLight& light, Vec3 p, Vec2 u) {
  std::optional<LightSample> s = draw(light.area, p, u);
  if (s) s->is_delta = true;
  return s;
}

std::optional<LightSample> draw(const VolumeLight& light, Vec3 p, Vec2 u) {
  const std::optional<VolumeLight::Direction> s = light.sample(p, u);
  if (!s) return std::nullopt;
  return LightSample{s->w, infinity, Rgb(1), s->pdf, false};
}

LightPoint point_of_delta_light(Vec3 p) {
  LightPoint point{.on = {}, .pdf_area = 1, .is_delta = true};
  point.on.p = p;
  return point;
}

Vec2 image_position(const ImageEnvironment& light, Vec3 w) {
  return octahedral_position(normalize(light.light_from_world.vector(w)));
}

Rgb power_of(const PointLight& light, float) { return light.I * (4 * pi); }

// The smooth step has the mean 1/2 over cosines in the edge.
Rgb power_of(const SpotLight& light, float) {
  return light.I * (2 * pi *
                    (1 - light.cos_falloff_start +
                     0.5f * (light.cos_falloff_start - light.cos_total)));
}

Rgb power_of(const DistantLight& light, float radius) {
  return light.L * (pi * sqr(radius));
}

Rgb power_of(const ConstantEnvironment& light, float radius) {
  return light.L * (4 * pi * pi * sqr(radius));
}

Rgb power_of(const ImageEnvironment& light, float radius) {
  double sum[3] = {0, 0, 0};
  for (const Rgb& pixel : light.pixels)
    for (int c = 0; c < 3; ++c) sum[c] += double{pixel[c]};
  const auto count = static_cast<double>(light.pixels.size());
  const Rgb mean{static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
                 static_cast<float>(sum[2] / count)};
  return mean * (4 * pi * pi * sqr(radius));
}

Rgb power_of(const VolumeLight& light, float) { return light.power(); }

Rgb power_of(const AreaLight& light, float) {
  return light.L * (pi * (light.two_sided ? 2.0f : 1.0f) * area(*light.shape));
}

Rgb power_of(const HiddenAreaLight& light, float radius) {
  return power_of(light.area, radius);
}

// Of visible and of hidden ones; null for other lights.
const AreaLight* area_light(const LightVariant& light) {
  if (const auto* hidden = std::get_if<HiddenAreaLight>(&light)) return &hidden->area;
  return std::get_if<AreaLight>(&light);
}

}  // namespace

Rgb SpotLight::intensity(Vec3 w) const {
  return I * smooth_step(dot(w, axis), cos_total, cos_falloff_start);
}

ImageEnvironment::ImageEnvironment(const Transform& the_world_from_light,
                                   int the_resolution, std::vector<Rgb> the_pixels,
                                   float scale)
    : world_from_light(the_world_from_light),
      light_from_world(the_world_from_light.inverse()),
      resolution(the_resolution),
      pixels(std::move(the_pixels)) {
  assert(resolution > 0);
  assert(pixels.size() ==
         static_cast<size_t>(resolution) * static_cast<size_t>(resolution));
  std::vector<float> weights;
  weights.reserve(pixels.size());
  for (Rgb& pixel : pixels) {
    pixel *= scale;
    weights.push_back(average(pixel));
  }
  distribution = PiecewiseConstant2D(weights, resolution, resolution);
}

Rgb ImageEnvironment::lookup(Vec2 p) const { return pixels[pixel_index(*this, p)]; }

std::optional<LightSample> Light::sample(Vec3 p, Vec2 u) const {
  return std::visit([&](const auto& light) { return draw(light, p, u); }, light_);
}

std::optional<LightPoint> Light::sample_point(Vec2 u) const {
  if (const auto* light = std::get_if<PointLight>(&light_))
    return point_of_delta_light(light->p);
  if (const auto* light = std::get_if<SpotLight>(&light_))
    return point_of_delta_light(light->p);
  if (const auto* light = std::get_if<VolumeLight>(&light_)) {
    LightPoint point{.on = {}, .pdf_area = 1, .is_delta = false};
    point.on.p = light->sample_point(u);
    return point;
  }
  const AreaLight* light = area_light(light_);
  if (!light) return std::nullopt;
  const ShapeSample s = sample_area(*light->shape, u);
  if (!(s.pdf_area > 0) || !std::isfinite(s.pdf_area)) return std::nullopt;
  return LightPoint{s.point, s.pdf_area, false};
}

Rgb Light::emission(const SurfacePoint& on, Vec3 w) const {
  if (const auto* light = std::get_if<PointLight>(&light_)) return light->I;
  if (const auto* light = std::get_if<SpotLight>(&light_)) return light->intensity(w);
  if (const AreaLight* light = area_light(light_)) return light->Le(on, w);
  return {};
}

std::optional<LightExtent> Light::extent() const {
  if (const auto* light = std::get_if<PointLight>(&light_))
    return LightExtent{{light->p, light->p}, {0, 0, 1}, -1};
  if (const auto* light = std::get_if<SpotLight>(&light_))
    return LightExtent{{light->p, light->p}, light->axis, light->cos_total};
  if (const AreaLight* light = area_light(light_))
    return LightExtent{bounds(*light->shape), {0, 0, 1}, -1};
  if (const auto* light = std::get_if<VolumeLight>(&light_))
    return LightExtent{light->bounds(), {0, 0, 1}, -1};
  return std::nullopt;
}

float Light::pdf(Vec3 from, const SurfacePoint& on) const {
  const auto* light = std::get_if<AreaLight>(&light_);
  return light ? direction_pdf(*light->shape, from, on) : 0;
}

float Light::pdf(Vec3 wi) const {
  if (std::holds_alternative<ConstantEnvironment>(light_)) return uniform_sphere_pdf();
  const auto* light = std::get_if<ImageEnvironment>(&light_);
  return light ? light->distribution.pdf(image_position(*light, wi)) * inv_4pi : 0;
}

Vec2 Light::invert(Vec3 wi) const {
  if (std::holds_alternative<ConstantEnvironment>(light_)) return invert_uniform_sphere(wi);
  const auto* light = std::get_if<ImageEnvironment>(&light_);
  return light ? light->distribution.invert(image_position(*light, wi)) : Vec2{};
}

float Light::pdf(Vec3 from, Vec3 w) const {
  const auto* light = std::get_if<VolumeLight>(&light_);
  return light ? light->pdf(from, w) : 0;
}

Rgb Light::environment(Vec3 w) const {
  if (const auto* light = std::get_if<ConstantEnvironment>(&light_)) return light->L;
  const auto* light = std::get_if<ImageEnvironment>(&light_);
  return light ? light->lookup(image_position(*light, w)) : Rgb{};
}

Rgb Light::power(float scene_radius) const {
  return std::visit([&](const auto& light) { return power_of(light, scene_radius); },
                    light_);
}

bool Light::is_infinite() const {
  return is_environment() || std::holds_alternative<DistantLight>(light_);
}

bool Light::is_environment() const {
  return std::holds_alternative<ConstantEnvironment>(light_) ||
         std::holds_alternative<ImageEnvironment>(light_);
}

}  // namespace tyndall
