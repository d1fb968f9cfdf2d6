// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/small_vector.hpp>
#include <cmath>
#include <span>

#include "tyndall/integrators/leg.h"
#include "tyndall/techniques/samples.h"

namespace tyndall {

/// A piecewise constant stand-in for the extinction along a whole leg, through all its
/// media: the mean of the channels of the media's own proxies. Densities and MIS weights
/// are made from it; it may be wrong, at the cost of variance only.
class LegProxy {
 public:
  /// Empty: no medium anywhere.
  LegProxy() = default;
  /// Traces the leg to its end.
  explicit LegProxy(Leg& leg);

  /// The part of the leg that can scatter; empty if t_min() >= t_max().
  float t_min() const { return t_min_; }
  float t_max() const { return t_max_; }
  bool is_empty() const { return !(t_min_ < t_max_); }
  /// The extinction is the same all along, from t_min() to t_max().
  bool is_uniform() const { return pieces_.size() == 1; }
  float first_sigma_t() const { return pieces_.front().sigma_t; }
  /// The medium at t_min(). Precondition: not empty.
  const Medium* first_medium() const { return pieces_.front().medium; }

  /// Asks for sigma_t, transmittance and medium at distances that do not decrease.
  class Cursor {
   public:
    explicit Cursor(const LegProxy& proxy) : proxy_(&proxy) {}
    void move_to(float t);
    float sigma_t() const { return sigma_t_; }  ///< [1/scene unit]
    float depth() const { return depth_; }      ///< optical
    float transmittance() const { return std::exp(-depth_); }
    const Medium* medium() const { return medium_; }  ///< null outside all

   private:
    const LegProxy* proxy_;
    size_t piece_ = 0;
    float sigma_t_ = 0, depth_ = 0;
    const Medium* medium_ = nullptr;
  };

  /// Density with which a walk collides at t [1/scene unit].
  float collision_pdf_t(float t) const;
  /// A distance for u in [0, 1), with the density collision_pdf_t() / share, up to where
  /// that share of the light has collided: empty if nothing scatters.
  std::optional<DistanceSample> sample(float u, float share) const;
  /// Puts the distances of sample() for ascending `u` in their place, to choose a density
  /// by: to about 1e-4 of the way. Precondition: not empty.
  void sample_roughly(std::span<float> u, float share) const;
  /// The share of the light that the leg does not let through, up to t.
  float collision_share(float t = far_distance) const;
  float transmittance(float t) const;
  /// Null where nothing scatters.
  const Medium* medium_at(float t) const;
  /// The distance at which the transmittance has fallen to `level`, at most t_max().
  float distance_to(float level) const;

 private:
  struct Piece {
    float t_min, t_max;
    float sigma_t;
    float depth;  // optical depth up to t_min
    const Medium* medium;
    float end_depth() const { return depth + sigma_t * (t_max - t_min); }
  };

  boost::container::small_vector<Piece, 8> pieces_;
  float t_min_ = 0, t_max_ = 0;
};

}  // namespace tyndall
