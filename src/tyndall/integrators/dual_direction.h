// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tyndall/guiding/direction_guide.h"
#include "tyndall/integrators/connection_leg.h"
#include "tyndall/integrators/scattering_lobe.h"
#include "tyndall/techniques/double_scattering_direction.h"

namespace tyndall {

/// The direction from a scattering vertex to the next, in a medium, from which light comes:
/// joint sampling, or where something has been learned a mixture of that with the learned
/// density and the lobe of the vertex, in learned shares.
class DualDirection {
 public:
  /// What is needed of a medium.
  struct Scattering {
    const ScatteringTables& tables;
    const PhaseFunction& phase;
  };
  /// For the vertex `b` in the medium, reached in the unit direction `w_ab`. Everything
  /// pointed to must outlive it; `guide` is null if nothing is known.
  DualDirection(const Scattering& scattering, Vec3 b, Vec3 w_ab, Vec3 pivot,
                const DirectionGuide* guide, bool with_product);
  /// For the vertex `b` on a surface that reflects to the side of the unit normal `n`; the
  /// tables are those of the medium around it.
  DualDirection(const ScatteringTables& tables, Vec3 b, Vec3 n, Vec3 pivot,
                const DirectionGuide* guide);

  /// Empty where the technique that u chooses finds nothing.
  std::optional<DoubleDirectionSample> sample(Vec2 u) const;
  /// Density of sample() at the unit vector w [1/sr].
  float pdf(Vec3 w) const;
  /// The density of each technique at w [1/sr].
  DirectionShares densities(Vec3 w) const;

 private:
  void guide_by(const DirectionGuide* guide, Vec3 to_pivot, bool with_product);
  std::optional<Vec3> sample_one(Vec2 u) const;

  DoubleScatteringDirection joint_;
  ScatteringLobe lobe_;
  const DirectionGuide* guide_ = nullptr;  // null: joint sampling alone
  std::optional<LightSquare> square_;
  std::optional<GaussianMixture> mixture_;  // times the lobe
};

/// The technique of a render at the vertex `b` in `medium`, for a light aimed at in
/// `pivot`.
DualDirection dual_direction(const ConnectionContext& context, const Medium& medium, Vec3 b,
                             Vec3 w_ab, size_t light, Vec3 pivot);
/// The same at `p` on a surface that reflects to the side of `n`; `medium` is around it, or
/// null.
DualDirection glow_direction(const ConnectionContext& context, const Medium* medium, Vec3 p,
                             Vec3 n, size_t light, Vec3 pivot);

}  // namespace tyndall
