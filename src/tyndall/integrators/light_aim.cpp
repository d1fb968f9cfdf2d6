// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/light_aim.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tyndall/integrators/leg_proxy.h"

namespace tyndall {
namespace {

constexpr int max_own_hits = 8;
// Of the points so many may lie out of the view, lest a few far ones coarsen the map.
constexpr float outlier_share = 0.005f;
// Of the range of the points' distances from the light: smaller jumps do not matter.
constexpr float edge_share = 0.03f;
// Of the points' distance.
constexpr float own_surface = 1e-4f;

float quantile(std::vector<float>& values, float share) {
  const auto last = static_cast<float>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * last);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

LightAim::LightAim(const Scene& scene, const Light& light, std::span<const Vec3> points)
    : scene_(&scene), light_(&light) {
  if (const std::optional<LightExtent> extent = light.extent()) {
    center_ = extent->box.center();
    aim_finite(points);
  } else {
    aim_parallel(light, points);
  }
}

void LightAim::aim_finite(std::span<const Vec3> points) {
  Vec3 sum;
  std::vector<float> distances, cosines;
  for (const Vec3 p : points) {
    const float distance = length(p - center_);
    if (!(distance > 0 && distance < infinity)) continue;
    distances.push_back(distance);
    sum += (p - center_) / distance;
  }
  view_ = LightView::around(center_);
  if (distances.empty()) return;
  focus_ = quantile(distances, 0.5f);
  range_ = quantile(distances, 1 - outlier_share);
  edge_depth_ = edge_share * (range_ - quantile(distances, outlier_share));
  const auto* spot = std::get_if<SpotLight>(&light_->variant());
  if (spot) view_ = LightView::cone(center_, spot->axis, spot->cos_total);
  if (!(length(sum) > 0)) return;
  const Vec3 axis = normalize(sum);
  for (const Vec3 p : points) {
    const float distance = length(p - center_);
    if (distance > 0) cosines.push_back(dot(p - center_, axis) / distance);
  }
  // A little wider than the points.
  const float angle =
      1.05f * std::acos(std::clamp(quantile(cosines, outlier_share), -1.0f, 1.0f));
  const LightView narrow = LightView::cone(center_, axis, std::cos(angle));
  if (!(narrow.extent() < view_.extent())) return;
  view_ = narrow;
  is_lit_outside_ = true;
}

void LightAim::aim_parallel(const Light& light, std::span<const Vec3> points) {
  Bounds3 box;
  for (const Vec3 p : points) box.extend(p);
  const std::optional<LightSample> sample = light.sample(box.center(), {0.5f, 0.5f});
  range_ = 2 * box.radius();
  edge_depth_ = edge_share * range_;
  view_ = LightView::parallel(sample ? sample->wi : Vec3{0, 0, 1}, box);
  beyond_ =
      2 * scene_->bounds().radius() + length(scene_->bounds().center() - box.center());
}

// What the light sends along a ray of the view; empty where it does not shine.
std::optional<Ray> LightAim::leave(const Ray& ray, Vec2 u) const {
  const bool is_finite = !light_->is_infinite();
  const Vec3 at = ray.at(is_finite ? focus_ : 0);
  const std::optional<LightSample> sample = light_->sample(at, u);
  if (!sample || is_black(sample->L)) return std::nullopt;
  const float distance = is_finite ? sample->distance : beyond_;
  return Ray{at + sample->wi * distance, -sample->wi};
}

float LightAim::reach(const Ray& ray, Vec2 u) const {
  std::optional<Ray> rest = leave(ray, u);
  if (!rest) return 0;
  for (int i = 0; i < max_own_hits; ++i) {
    const std::optional<SurfaceHit> hit = scene_->intersect_opaque(*rest, infinity);
    if (!hit) return infinity;
    if (hit->light != light_)
      return light_->is_infinite() ? dot(hit->point.p - ray.o, ray.d)
                                   : length(hit->point.p - center_);
    rest->o = offset_origin(hit->point.p, hit->point.ng, rest->d);
  }
  return 0;
}

void LightAim::optical_depth(const Ray& ray, std::span<const float> t,
                             std::span<float> out) const {
  std::ranges::fill(out, 0.0f);
  std::optional<Ray> start = leave(ray, {0.5f, 0.5f});
  if (!start) return;
  // Clear of the light's own surface.
  start->o = start->at(own_surface * focus_);
  const float before = light_->is_infinite() ? beyond_ : -length(start->o - center_);
  Leg leg(*scene_, *start, medium_at(*scene_, start->o));
  const LegProxy proxy(leg);
  if (proxy.is_empty()) return;
  LegProxy::Cursor cursor(proxy);
  for (size_t i = 0; i < t.size(); ++i) {
    cursor.move_to(std::max(t[i] + before, 0.0f));
    out[i] = -std::log(std::max(cursor.transmittance(), 1e-30f));
  }
}

}  // namespace tyndall
