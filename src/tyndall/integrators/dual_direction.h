// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/guiding/direction_guide.h"
#include "tyndall/integrators/connection_leg.h"
#include "tyndall/techniques/double_scattering_direction.h"

namespace tyndall {

/// The direction from the first to the second scattering vertex of a dual connection: joint
/// sampling, or where something has been learned a mixture of that with the learned density
/// and the phase function, in learned shares.
class DualDirection {
 public:
  /// What is needed of a medium.
  struct Scattering {
    const ScatteringTables& tables;
    const PhaseFunction& phase;
  };
  /// For the vertex `b`, reached in the unit direction `w_ab`. Everything pointed to must
  /// outlive it; `guide` is null if nothing is known.
  DualDirection(const Scattering& scattering, Vec3 b, Vec3 w_ab, Vec3 pivot,
                const DirectionGuide* guide, bool with_product);

  /// Empty where the technique that u chooses finds nothing.
  std::optional<DoubleDirectionSample> sample(Vec2 u) const;
  /// Density of sample() at the unit vector w [1/sr].
  float pdf(Vec3 w) const;
  /// The density of each technique at w [1/sr].
  DirectionShares densities(Vec3 w) const;

 private:
  std::optional<Vec3> sample_one(Vec2 u) const;

  DoubleScatteringDirection joint_;
  const PhaseFunction* phase_;
  Vec3 wo_;
  const DirectionGuide* guide_ = nullptr;  // null: joint sampling alone
  std::optional<LightSquare> square_;
  GaussianMixture mixture_;  // times the phase function
};

/// The technique of a render at the vertex `b` in `medium`, for a light aimed at in
/// `pivot`.
DualDirection dual_direction(const ConnectionContext& context, const Medium& medium, Vec3 b,
                             Vec3 w_ab, size_t light, Vec3 pivot);

}  // namespace tyndall
