// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// Coefficients times a length, where zero times infinity is zero.
inline Rgb optical_depth(Rgb sigma, float length) {
  return {sigma.r != 0 ? sigma.r * length : 0, sigma.g != 0 ? sigma.g * length : 0,
          sigma.b != 0 ? sigma.b * length : 0};
}

/// Where a walk stands in a segment. In media so dense that a free flight is shorter than
/// the floats there lie apart, it must get on all the same: what rounding has left out is
/// kept for the next one.
class SegmentPosition {
 public:
  explicit SegmentPosition(const MediumSegment& segment)
      : t_(segment.t_min), t_max_(segment.t_max) {}

  float t() const { return t_; }
  /// The length that is left of the segment.
  float rest() const { return t_max_ - t_; }
  void advance(float length) {
    const float step = length + left_out_, before = t_;
    t_ = std::min(before + step, t_max_);
    left_out_ = step - (t_ - before);
  }

 private:
  float t_, t_max_, left_out_ = 0;
};

/// An exponentially distributed optical depth of mean one.
inline float sample_optical_depth(RandomStream& rng) {
  return -std::log(1 - rng.next_1d());
}

/// Tentative collisions along a ray: a Poisson process whose rate is the majorant of
/// channel `hero` [PBRT4, Sec. 11.2]. One exponential is drawn per collision and spent over
/// as many segments as it lasts.
///
/// on_collision(float t, const MediumProperties& at_t, Rgb majorant, Rgb T_maj) returns
/// whether to go on. T_maj is the transmittance of the majorants since the last collision,
/// or the ray's start, *relative to the hero's*: exactly one in grey media. With it the
/// probability of channel c to have made the same walk is the hero's times T_maj[c]
/// majorant[c] / majorant[hero], as single-sample MIS over channels needs it.
///
/// Returns the relative T_maj of the rest of the ray up to t_max; irrelevant if
/// on_collision stopped the walk. In homogeneous media every collision is real.
template <typename M, typename F>
Rgb sample_collisions(const M& medium, const Ray& ray, float t_max, int hero,
                      RandomStream& rng, F&& on_collision) {
  const bool is_grey = medium.is_grey();
  auto segments = medium.segments(ray, t_max);
  MediumSegment s;
  float remaining = sample_optical_depth(rng);
  Rgb excess;  // optical depth of the majorants beyond the hero's
  while (segments.next(s)) {
    const float majorant = s.majorant[hero];
    const Rgb beyond = s.majorant - Rgb(majorant);
    SegmentPosition position(s);
    while (majorant > 0) {
      const float depth = majorant * position.rest();
      if (remaining >= depth) {
        remaining -= depth;
        break;
      }
      const float flight = remaining / majorant;
      position.advance(flight);
      if (!is_grey) excess += optical_depth(beyond, flight);
      const float t = position.t();
      if (!on_collision(t, segments.at(t), s.majorant, is_grey ? Rgb(1) : exp(-1 * excess)))
        return Rgb(0);
      excess = Rgb(0);
      remaining = sample_optical_depth(rng);
    }
    if (!is_grey) excess += optical_depth(beyond, position.rest());
  }
  return is_grey ? Rgb(1) : exp(-1 * excess);
}

}  // namespace tyndall
