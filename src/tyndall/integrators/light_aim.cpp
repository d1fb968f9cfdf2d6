// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/light_aim.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tyndall {
namespace {

constexpr int max_own_hits = 8;
// Of the points so many may lie out of the view, lest a few far ones coarsen the map.
constexpr float outlier_share = 0.005f;
// Of the range of the points' distances from the light: smaller jumps do not matter.
constexpr float edge_share = 0.03f;

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
  edge_depth_ = edge_share * (quantile(distances, 1 - outlier_share) -
                              quantile(distances, outlier_share));
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
  edge_depth_ = edge_share * 2 * box.radius();
  view_ = LightView::parallel(sample ? sample->wi : Vec3{0, 0, 1}, box);
  beyond_ =
      2 * scene_->bounds().radius() + length(scene_->bounds().center() - box.center());
}

float LightAim::reach(const Ray& ray, Vec2 u) const {
  const bool is_finite = !light_->is_infinite();
  const Vec3 at = ray.at(is_finite ? focus_ : 0);
  const std::optional<LightSample> sample = light_->sample(at, u);
  if (!sample || is_black(sample->L)) return 0;
  const float distance = is_finite ? sample->distance : beyond_;
  Ray rest{at + sample->wi * distance, -sample->wi};
  for (int i = 0; i < max_own_hits; ++i) {
    const std::optional<SurfaceHit> hit = scene_->intersect_opaque(rest, infinity);
    if (!hit) return infinity;
    if (hit->light != light_)
      return is_finite ? length(hit->point.p - center_) : dot(hit->point.p - ray.o, ray.d);
    rest.o = offset_origin(hit->point.p, hit->point.ng, rest.d);
  }
  return 0;
}

}  // namespace tyndall
