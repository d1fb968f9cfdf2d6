// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/guiding/gaussian_mixture.h"
#include "tyndall/guiding/guide_lobes.h"
#include "tyndall/guiding/learned_shares.h"
#include "tyndall/guiding/light_square.h"

namespace tyndall {

/// The techniques whose shares a guide learns, in the order of its shares.
enum class DirectionTechnique { mixture, joint_sampling, phase };
inline constexpr size_t direction_techniques = 3;
using DirectionShares = Shares<direction_techniques>;

/// A direction and its density w.r.t. solid angle [1/sr].
struct GuidedDirection {
  Vec3 w;
  float pdf;
};

/// What a record knows of the directions from which the light of one cluster arrives: a
/// mixture on the light's square. Untrained it is the density of joint sampling (or the
/// uniform one, for lights at infinity).
struct DirectionGuide {
  GaussianMixture mixture;
  GuideLobes lobes;  ///< of the mixture
  Frame reference = Frame::from_z({0, 0, 1});
  SquareMeasure measure = SquareMeasure::joint_sampling;
  DirectionShares shares{0.4f, 0.4f, 0.2f};

  /// The square centred on the light as the query point sees it: this corrects the parallax
  /// of the light. Make it once and ask it often.
  LightSquare square(Vec3 light_direction) const {
    return {turned_frame(reference, light_direction), measure};
  }
  void set_mixture(const GaussianMixture& m) {
    mixture = m;
    lobes = GuideLobes::of(m, measure);
  }
  /// The mixture times the phase function of mean cosine g of a vertex that was reached in
  /// the unit direction `w_ab`, as far as changing the weights of the components can make
  /// it.
  GaussianMixture product(const LightSquare& square, Vec3 w_ab, float g) const {
    if (g == 0 || mixture.is_uniform()) return mixture;
    return mixture.reweighted(lobes.phase_factors(square.frame().to_local(w_ab), g));
  }
  /// Draws a direction from the mixture alone; empty where it leaves the square.
  std::optional<GuidedDirection> sample(const LightSquare& square, Vec2 u) const {
    const std::optional<MixtureSample> s = mixture.sample(u);
    if (!s) return std::nullopt;
    const SquareDirection d = square.direction(s->p);
    return GuidedDirection{.w = d.w, .pdf = s->pdf * d.density};
  }
  /// Density of sample() [1/sr].
  float pdf(const LightSquare& square, Vec3 w) const {
    const SquarePoint q = square.point(w);
    return mixture.pdf(q.p) * q.density;
  }
  float share(DirectionTechnique technique) const {
    return shares[static_cast<size_t>(technique)];
  }
};

}  // namespace tyndall
