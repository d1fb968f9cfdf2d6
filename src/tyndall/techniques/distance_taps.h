// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace tyndall {

/// Points along a ray at which factors of an integrand are looked at, as arrays: the points
/// u = (i + 1/2) / K of a distance technique, in the order of t. Not to be used as samples:
/// they are computed in float recurrences, to choose a density by.
template <int K>
struct DistanceTaps {
  static constexpr int count = K;

  alignas(32) std::array<float, K> t;          ///< distance along the ray
  alignas(32) std::array<float, K> distance;   ///< from the pivot
  alignas(32) std::array<float, K> cos_alpha;  ///< between ray and direction to the pivot
};

}  // namespace tyndall
