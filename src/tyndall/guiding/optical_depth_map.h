// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tyndall/guiding/light_view.h"

namespace tyndall {

/// Predicts the transmittance between a light and points in a heterogeneous medium: the
/// optical depth along the light's rays at some distances each, interpolated between them.
///
/// The distances grow with the square of their number, so that they are densest at the
/// light. Beyond the range the depth stays what it was. A prediction costs variance when it
/// is wrong, never bias.
class OpticalDepthMap {
 public:
  /// Optical depth of the ray up to each of some ascending distances, for a channel or a
  /// mean of them. `out` is as long as `t`.
  using Depth =
      std::function<void(const Ray& ray, std::span<const float> t, std::span<float> out)>;

  /// Empty space, until traced. `range` is the distance at which the medium ends [scene
  /// units].
  OpticalDepthMap(const LightView& view, float range, int resolution = 64, int steps = 16);

  int rows() const { return resolution_; }
  /// Fills rows [begin, end); different rows may be filled by different threads.
  void trace_rows(int begin, int end, const Depth& depth);

  float transmittance(Vec3 p) const;
  /// The same for the points ray.at(t[i]). `out` is as long as `t`.
  void transmittance(const Ray& ray, std::span<const float> t, std::span<float> out) const;

  size_t memory() const { return depth_.size() * sizeof(float); }  ///< [bytes]

 private:
  float distance_of(int step) const;
  float predict(float u, float v, float distance) const;

  LightView view_;
  float range_;
  int resolution_, steps_;
  std::vector<float> depth_;  // steps + 1 values a texel, the first is zero
};

}  // namespace tyndall
