// SPDX-License-Identifier: Apache-2.0
#include "tyndall/lights/volume_light.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "tyndall/math/scalar.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// A point in a volume takes more numbers than a direction has: these follow from the two.
RandomStream more_numbers(Vec2 u) {
  return RandomStream(hash(std::bit_cast<uint32_t>(u.x), std::bit_cast<uint32_t>(u.y)));
}

}  // namespace

VolumeLight::VolumeLight(std::vector<EmissionDistribution> parts) {
  assert(!parts.empty());
  std::vector<Part> made;
  for (EmissionDistribution& part : parts) {
    const Bounds3 box = part.bounds();
    power_ += part.power();
    bounds_.extend(box);
    const float power = average(part.power());
    made.push_back({std::move(part), power, box.center(), box.radius()});
  }
  parts_ = std::make_shared<const std::vector<Part>>(std::move(made));
}

VolumeLight::Choice VolumeLight::choice_at(Vec3 p) const {
  Choice cumulative;
  float sum = 0;
  for (const Part& part : *parts_) {
    sum +=
        part.power / std::max({distance_squared(p, part.center), sqr(part.radius), 1e-20f});
    cumulative.push_back(sum);
  }
  for (float& c : cumulative) c /= sum;
  return cumulative;
}

std::optional<VolumeLight::Direction> VolumeLight::sample(Vec3 p, Vec2 u) const {
  RandomStream more = more_numbers(u);
  const float u_part = parts_->size() > 1 ? more.next_1d() : 0;
  const Choice choice = choice_at(p);
  size_t i = 0;
  while (i + 1 < choice.size() && u_part >= choice[i]) ++i;
  const float y = more.next_1d(), z = more.next_1d();
  const Vec3 to = (*parts_)[i].distribution.sample(u.x, {u.y, y, z}).p - p;
  const float distance = length(to);
  if (!(distance > 0) || !std::isfinite(distance)) return std::nullopt;
  const Vec3 w = to / distance;
  return Direction{w, pdf(p, w)};
}

float VolumeLight::pdf(Vec3 p, Vec3 w) const {
  const Choice choice = choice_at(p);
  float sum = 0, below = 0;
  for (size_t i = 0; i < choice.size(); ++i) {
    const float probability = choice[i] - below;
    below = choice[i];
    if (probability > 0) sum += probability * (*parts_)[i].distribution.pdf_direction(p, w);
  }
  return sum;
}

Vec3 VolumeLight::sample_point(Vec2 u) const {
  RandomStream more = more_numbers(u);
  float u_part = more.next_1d() * average(power_);
  size_t i = 0;
  while (i + 1 < parts_->size() && u_part >= (*parts_)[i].power)
    u_part -= (*parts_)[i++].power;
  const float y = more.next_1d(), z = more.next_1d();
  return (*parts_)[i].distribution.sample(u.x, {u.y, y, z}).p;
}

}  // namespace tyndall
