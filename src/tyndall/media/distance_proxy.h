// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/medium_properties.h"

namespace tyndall {

/// A piecewise constant stand-in for the extinction along a ray, read from the means of a
/// medium's segments, with everything in closed form: what multiple importance sampling of
/// distances needs and tracking cannot give. Exact in homogeneous media.
///
/// Distances are drawn with density proportional to sigma_hat T_hat, given that there is a
/// collision before t_max. With chromatic media the density is the mean of the channels'
/// densities, over those channels that the ray can collide in; so it is positive wherever
/// any channel's mean is. A value, built once per ray; it keeps no reference to the medium.
class DistanceProxy {
 public:
  /// Segments beyond this many are merged with the last one. Grid media have fewer.
  static constexpr size_t capacity = 128;

  template <typename M>
  DistanceProxy(const M& medium, const Ray& ray, float t_max)
      : channels_(medium.is_grey() ? 1 : 3) {
    auto segments = medium.segments(ray, t_max);
    MediumSegment s;
    while (segments.next(s)) add(s);
    finish();
  }

  /// A distance drawn along the ray.
  struct Sample {
    float t;      ///< distance from the ray's origin [scene units]
    float pdf_t;  ///< density w.r.t. length along the ray [1/scene unit]
  };
  /// Empty if the ray meets nothing. Monotonic in u.
  std::optional<Sample> sample(float u) const;
  /// Density of sample() at t [1/scene unit]; zero where it never samples.
  float pdf_t(float t) const;
  /// The u that sample() maps to t; the share of the density below t.
  float invert(float t) const;

  /// Optical depth of the proxy from the ray's origin to t, per channel.
  Rgb optical_depth(float t) const;
  /// T_hat(t) = exp(-optical_depth(t)).
  Rgb transmittance(float t) const;
  /// sigma_hat(t) [1/scene unit].
  Rgb sigma_t(float t) const;
  /// 1 - T_hat(t_max), averaged over the channels: how likely a collision is.
  float opacity() const;

 private:
  using Column = std::array<float, capacity>;

  void add(const MediumSegment& s);
  void finish();
  size_t segment_at(float t) const;
  double cdf(size_t i, float length) const;
  float solve(size_t i, double u) const;
  float depth(int channel, size_t i, float length) const {
    const float sigma = sigma_[static_cast<size_t>(channel)][i];
    return depth_[static_cast<size_t>(channel)][i] + (sigma > 0 ? sigma * length : 0);
  }
  Rgb spread(Rgb v) const { return channels_ == 1 ? Rgb(v.r) : v; }

  int channels_;
  size_t size_ = 0;
  Column t_min_, t_max_;
  std::array<Column, 3>
      sigma_;  // sigma_hat of each segment; only the first channel if grey
  std::array<Column, 3> depth_;  // optical depth up to the start of each segment
  Rgb total_;                    // optical depth of the whole ray
  Rgb weight_;                   // 1 / (channels that can collide * opacity of the channel)
};

}  // namespace tyndall
