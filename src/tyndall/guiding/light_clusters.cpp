// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/light_clusters.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace tyndall {

namespace {

using Group = std::vector<uint32_t>;  // indices of lights

// The axis along which the lights' power is spread most, its mean there, and the spread:
// the power times the variance. Lights without power count a little, so that they are
// separated too.
struct Spread {
  int axis = 0;
  double mean = 0, value = 0;
};

Spread spread_of(const Group& group, std::span<const ClusterableLight> lights) {
  Spread widest;
  for (int axis = 0; axis < 3; ++axis) {
    double weight = 0, sum = 0;
    for (const uint32_t i : group) {
      const double w = static_cast<double>(lights[i].power) + 1e-30;
      weight += w;
      sum += w * static_cast<double>(lights[i].p[axis]);
    }
    const double mean = sum / weight;
    double value = 0;
    for (const uint32_t i : group) {
      const double d = static_cast<double>(lights[i].p[axis]) - mean;
      value += (static_cast<double>(lights[i].power) + 1e-30) * d * d;
    }
    if (value > widest.value) widest = {axis, mean, value};
  }
  return widest;
}

// Cuts the group that is spread most in two; false if all lights of each group coincide.
bool cut(std::vector<Group>& groups, std::span<const ClusterableLight> lights) {
  Spread widest;
  size_t chosen = 0;
  for (size_t g = 0; g < groups.size(); ++g) {
    const Spread s = spread_of(groups[g], lights);
    if (s.value > widest.value) widest = s, chosen = g;
  }
  if (!(widest.value > 0)) return false;
  Group& group = groups[chosen];
  const auto middle = std::stable_partition(group.begin(), group.end(), [&](uint32_t i) {
    return static_cast<double>(lights[i].p[widest.axis]) < widest.mean;
  });
  if (middle == group.begin() || middle == group.end()) return false;
  Group upper(middle, group.end());
  group.erase(middle, group.end());
  groups.push_back(std::move(upper));
  return true;
}

}  // namespace

LightClusters cluster_lights(std::span<const ClusterableLight> lights,
                             size_t max_clusters) {
  assert(max_clusters >= 2);
  Group finite;
  std::vector<Group> infinite, groups;
  for (uint32_t i = 0; i < lights.size(); ++i)
    if (lights[i].is_infinite)
      infinite.push_back({i});
    else
      finite.push_back(i);
  const size_t room = max_clusters - (finite.empty() ? 0 : 1);
  while (infinite.size() > room) {
    infinite[room - 1].push_back(infinite.back().front());
    infinite.pop_back();
  }
  if (!finite.empty()) groups.push_back(std::move(finite));
  while (!groups.empty() && groups.size() + infinite.size() < max_clusters &&
         cut(groups, lights)) {
  }

  LightClusters result;
  result.cluster_of.resize(lights.size());
  for (const std::vector<Group>* kind : {&groups, &infinite})
    for (const Group& group : *kind) {
      float power = 0;
      for (const uint32_t i : group) {
        result.cluster_of[i] = static_cast<uint32_t>(result.size());
        power += lights[i].power;
      }
      result.power.push_back(power);
      result.is_infinite.push_back(kind == &infinite);
    }
  return result;
}

}  // namespace tyndall
