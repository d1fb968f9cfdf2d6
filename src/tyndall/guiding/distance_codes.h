// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tyndall/math/constants.h"

namespace tyndall {

/// Distances as bytes, in steps that grow with the distance: fast to compare, and four to a
/// word. With d / (d + typical) cut into 254 steps, distances about the typical one are
/// told apart to 1.6 %. An occluder is never taken for nearer than it is, nor a point for
/// farther: what is not hidden is not said to be.
class DistanceCodes {
 public:
  /// Four occluders.
  using Four = uint32_t;

  /// `typical` > 0: about which distance it matters most [scene units].
  explicit DistanceCodes(float typical = 1) : typical_(typical) {}

  /// Of occluders at these distances; infinity for none, zero or less for darkness.
  Four encode(const std::array<float, 4>& distances) const {
    Four four = 0;
    for (size_t i = 0; i < 4; ++i) four |= encode_occluder(distances[i]) << (8 * i);
    return four;
  }

  /// Of a point; distance >= 0 and finite.
  [[gnu::always_inline]] uint32_t encode_point(float distance) const {
    const float step = steps * (distance / (distance + typical_));
    return static_cast<uint32_t>(static_cast<int32_t>(step));
  }

  /// The share of the occluders that lie beyond the point.
  [[gnu::always_inline]] static float share_beyond(Four occluders, uint32_t point) {
    const uint32_t a = (occluders & 0xff) > point ? 1 : 0;
    const uint32_t b = ((occluders >> 8) & 0xff) > point ? 1 : 0;
    const uint32_t c = ((occluders >> 16) & 0xff) > point ? 1 : 0;
    const uint32_t d = (occluders >> 24) > point ? 1 : 0;
    return 0.25f * static_cast<float>(static_cast<int32_t>(a + b + c + d));
  }

 private:
  static constexpr float steps = 254;
  static constexpr uint32_t nothing = 255;

  uint32_t encode_occluder(float distance) const {
    if (!(distance > 0)) return 0;
    if (distance == infinity) return nothing;
    const float step = std::ceil(steps * (distance / (distance + typical_)));
    return static_cast<uint32_t>(std::clamp(step, 1.0f, steps));
  }

  float typical_;
};

}  // namespace tyndall
