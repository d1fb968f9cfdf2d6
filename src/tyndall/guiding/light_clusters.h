// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tyndall/math/vec.h"

namespace tyndall {

/// A light as clustering sees it.
struct ClusterableLight {
  Vec3 p;           ///< its middle; ignored for lights at infinity
  float power = 1;  ///< not negative; by the same measure for all
  bool is_infinite = false;
};

/// Which cluster each light belongs to, and what the clusters are.
struct LightClusters {
  std::vector<uint32_t> cluster_of;  ///< by light
  std::vector<float> power;          ///< by cluster: the sum of its lights
  std::vector<bool> is_infinite;     ///< by cluster

  size_t size() const { return power.size(); }
};

/// Divides lights into at most `max_clusters` clusters: lights at infinity alone, one each,
/// the others by where they are, always cutting the cluster whose power is spread most. If
/// there are too many at infinity, the last ones share a cluster. Deterministic.
///
/// Precondition: max_clusters is at least two.
LightClusters cluster_lights(std::span<const ClusterableLight> lights, size_t max_clusters);

}  // namespace tyndall
