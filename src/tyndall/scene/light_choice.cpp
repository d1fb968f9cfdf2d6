// SPDX-License-Identifier: Apache-2.0
#include "tyndall/scene/light_choice.h"

#include <algorithm>
#include <cmath>

#include "tyndall/math/constants.h"
#include "tyndall/math/fast_angle.h"

namespace tyndall {
namespace {

// Share of the choice that looks at power alone. Importance knows no occlusion, no cones
// and no emission profiles, so it may be wrong by much; this bounds the damage.
constexpr float power_share = 0.1f;

// Beyond this many lights, tables per place cost more than they save.
constexpr size_t max_candidates = 256;

}  // namespace

LightChoice::LightChoice(const std::vector<Light>& lights, const Bounds3& scene_bounds)
    : scene_radius_(std::max(scene_bounds.radius(), 1e-6f)) {
  for (const Light& light : lights) {
    const std::optional<LightExtent> extent = light.extent();
    const float power = luminance(light.power(scene_radius_));
    candidates_.push_back({extent ? extent->box.center() : Vec3{},
                           extent ? extent->box.radius() : 0, power, !extent});
    power_ += power;
    if (extent) finite_power_ += power;
  }
}

template <typename Importance>
LightProbabilities LightChoice::build(float total_power,
                                      const Importance& importance) const {
  LightProbabilities result;
  if (!(total_power > 0)) return result;
  auto& cdf = result.cdf_;
  cdf.resize(candidates_.size(), 1);
  if (cdf.size() == 1) {
    result.importance_ = importance(candidates_.front());
    return result;
  }
  float sum = 0;
  const bool by_power = candidates_.size() > max_candidates;
  for (size_t i = 0; i < candidates_.size(); ++i)
    cdf[i] = by_power ? 0 : importance(candidates_[i]), sum += cdf[i];
  result.importance_ = sum;
  const float scale = sum > 0 && std::isfinite(sum) ? (1 - power_share) / sum : 0;
  const float power_scale = (scale > 0 ? power_share : 1) / total_power;
  const bool finite_only = total_power == finite_power_ && total_power != power_;
  float running = 0;
  for (size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& c = candidates_[i];
    const float by_importance = scale > 0 ? scale * cdf[i] : 0;
    running += by_importance + (finite_only && c.is_infinite ? 0 : power_scale * c.power);
    cdf[i] = running;
  }
  for (float& value : cdf) value /= running;
  return result;
}

LightProbabilities LightChoice::at_point(Vec3 p) const {
  return build(power_, [&](const Candidate& c) {
    const float distance2 =
        c.is_infinite ? sqr(scene_radius_) : distance_squared(p, c.center);
    return c.power / std::max(distance2 + sqr(c.radius), 1e-20f);
  });
}

LightProbabilities LightChoice::along(const Ray& ray, float t_min, float t_max) const {
  return build(finite_power_, [&](const Candidate& c) {
    if (c.is_infinite) return 0.0f;
    const float t_foot = dot(c.center - ray.o, ray.d);
    const float h = std::max(std::sqrt(distance_squared(ray.at(t_foot), c.center)),
                             std::max(c.radius, 1e-6f * scene_radius_));
    // Of the directions to the two ends, seen from the light.
    const float angle = fast_angle(sqr(h) + (t_min - t_foot) * (t_max - t_foot),
                                   h * std::max(t_max - t_min, 0.0f));
    return c.power * angle / h;
  });
}

LightProbabilities LightChoice::at_infinity() const {
  LightProbabilities result;
  const float total = power_ - finite_power_;
  if (!(total > 0)) return result;
  float running = 0;
  for (const Candidate& c : candidates_)
    result.cdf_.push_back((running += c.is_infinite ? c.power : 0) / total);
  for (float& value : result.cdf_) value *= total / running;
  return result;
}

std::optional<SelectedLight> LightProbabilities::select(const std::vector<Light>& lights,
                                                        float u) const {
  if (cdf_.empty()) return std::nullopt;
  const auto found = std::upper_bound(cdf_.begin(), cdf_.end(), u);
  const auto index = static_cast<size_t>(
      std::min(found - cdf_.begin(), static_cast<std::ptrdiff_t>(cdf_.size()) - 1));
  return SelectedLight{&lights[index], index, probability(index)};
}

float LightProbabilities::probability(size_t index) const {
  if (cdf_.empty()) return 0;
  return index == 0 ? cdf_[0] : cdf_[index] - cdf_[index - 1];
}

LightProbabilities LightProbabilities::reweighed(std::span<const float> factors) const {
  LightProbabilities result;
  result.importance_ = importance_;
  float total = 0;
  for (size_t i = 0; i < cdf_.size(); ++i)
    result.cdf_.push_back(total += probability(i) * factors[i]);
  if (!(total > 0 && total < infinity)) return *this;
  for (float& c : result.cdf_) c /= total;
  result.cdf_.back() = 1;
  return result;
}

}  // namespace tyndall
