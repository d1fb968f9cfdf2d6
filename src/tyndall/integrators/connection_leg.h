// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tyndall/integrators/collision_distance.h"
#include "tyndall/integrators/connection_settings.h"
#include "tyndall/integrators/direction_guiding.h"
#include "tyndall/integrators/leg_proxy.h"
#include "tyndall/integrators/light_visibility.h"
#include "tyndall/integrators/lit_surface.h"
#include "tyndall/media/tracking.h"
#include "tyndall/scene/light_choice.h"
#include "tyndall/techniques/binned_distance.h"
#include "tyndall/techniques/double_scattering_distance.h"
#include "tyndall/techniques/equiangular.h"
#include "tyndall/techniques/scattering_tables.h"

namespace tyndall {

/// What all connections of a render share. Changes in update() only.
class ConnectionContext {
 public:
  ConnectionContext(const Scene& scene, const ConnectionSettings& settings);

  const Scene& scene() const { return *scene_; }
  const ConnectionSettings& settings() const { return settings_; }
  const LightChoice& light_choice() const { return light_choice_; }
  /// The tables of a medium's phase function.
  const ScatteringTables& tables(const Medium& medium) const;
  /// The same for what a surface looks into: from vacuum, the first medium of the scene.
  const ScatteringTables& tables_around(const Medium* medium) const {
    return medium ? tables(*medium) : *by_mean_cosine_.begin()->second;
  }
  /// Null if visibility is not predicted.
  const LightVisibility* visibility() const { return visibility_.get(); }
  /// Whether dual connections, and those to glow, are made: there are lights to aim at.
  bool makes_dual() const { return settings_.dual && light_choice_.has_finite_lights(); }
  /// Whether it is predicted what lights at infinity see.
  bool foresees_far_lights() const { return foresees_far_lights_; }
  /// Null if lit surfaces are not connected to.
  const LitSurfaceSampling* lit_surfaces() const { return lit_ ? &*lit_ : nullptr; }
  /// The transmittance over a distance, as the densities of walks have it, where one
  /// homogeneous medium fills the scene; elsewhere one. Never zero: nothing that a walk
  /// finds may have all of its densities zero.
  float filling_transmittance(float distance) const {
    constexpr float least = 1e-20f;
    const Rgb sigma_t = filling_sigma_t_;
    if (is_black(sigma_t)) return 1;
    const float T = is_grey(sigma_t) ? std::exp(-sigma_t.r * distance)
                                     : average(exp(-1 * optical_depth(sigma_t, distance)));
    return std::max(T, least);
  }
  /// Null if directions are not learned.
  const DirectionGuiding* guiding() const { return guiding_.get(); }
  DirectionGuiding* guiding() { return guiding_.get(); }

  /// Learns from what connections found so far. Not while paths are traced.
  void update() {
    if (lit_) lit_->update();
  }
  /// No more connections to lit surfaces. Not while paths are traced.
  void forget_lit_surfaces() { lit_.reset(); }

 private:
  const Scene* scene_;
  ConnectionSettings settings_;
  LightChoice light_choice_;
  std::shared_ptr<const LightVisibility> visibility_;
  bool foresees_far_lights_ = false;
  Rgb filling_sigma_t_;
  std::optional<LitSurfaceSampling> lit_;
  std::unique_ptr<DirectionGuiding> guiding_;
  // Sorted: looked up for every connection, and seldom in the processor's caches.
  std::vector<std::pair<const Medium*, const ScatteringTables*>> tables_;
  std::map<float, std::unique_ptr<const ScatteringTables>> by_mean_cosine_;
};

/// One point of each light, fixed for a path: what its techniques aim at. Techniques that
/// share a path share the points, so that each density can be evaluated by all of them; the
/// light is then sampled properly from the vertex before it.
class Pivots {
 public:
  Pivots(const Scene& scene, uint64_t key) : scene_(&scene), key_(key) {}
  /// Empty for lights at infinity. Not for several threads at once: it keeps the last.
  std::optional<Vec3> operator()(size_t light) const;

 private:
  const Scene* scene_;
  uint64_t key_;
  mutable std::optional<size_t> last_light_;
  mutable std::optional<Vec3> last_;
};

/// Where a leg begins, as far as the densities of other techniques need to know.
struct LegStart {
  Vec3 p;
  float t = 0;              ///< of p along the leg before
  float pdf_direction = 1;  ///< with which the walk turns into the leg [1/sr]
  bool is_specular = true;  ///< the camera, or a Dirac delta: the direction has no density
  bool is_in_medium = false;
  Vec3 ng;                         ///< of a surface, on the side of the leg before
  bool can_be_lit = false;         ///< a surface that LitSurfaceSampling finds
  bool sees_glow = false;          ///< a surface from which glow is connected to
  const Medium* medium = nullptr;  ///< around it
};

/// The densities of the scattering vertices that connections put on one leg.
class ConnectionLeg {
 public:
  /// No connections.
  ConnectionLeg() = default;
  ConnectionLeg(const ConnectionLeg&) = delete;
  ConnectionLeg& operator=(const ConnectionLeg&) = delete;
  /// Traces the leg to its end.
  ConnectionLeg(const ConnectionContext& context, const Pivots& pivots, Leg& leg,
                bool is_first = false);

  /// Whether lights that single() leaves out are connected to from a forced collision: on
  /// first legs that a walk may well pass without one, and on all where it is predicted
  /// what lights at infinity see.
  bool forces_collisions() const { return forces_collisions_; }
  /// Whether the light is one of those, and t is where collisions are forced.
  bool is_forced(size_t light, float t) {
    return forces_collisions_ && t <= t_max_ && forced_light_probability(light) > 0;
  }
  const Ray& ray() const { return ray_; }
  const LegProxy& proxy() const { return proxy_; }
  bool is_empty() const { return !context_ || proxy_.is_empty(); }

  /// Draws a light for connections; those at infinity are never drawn.
  std::optional<SelectedLight> select_light(float u);
  float light_probability(size_t light);
  /// See LightProbabilities: what single scattering along the leg may find. Zero, for
  /// unknown, where lights are many: to look at each of them takes longer than it gains.
  float light_importance();
  /// The point that the techniques aim at; empty for lights at infinity.
  std::optional<Vec3> pivot(size_t light) const { return (*pivots_)(light); }

  /// The last vertex before the light. Null where its distance hardly varies.
  using Single = BinnedDistance<EquiangularSampling, 64>;
  const Single* single(size_t light);
  /// Whether single(light) can put a vertex at t: its bins are not needed for that.
  bool reaches_single(size_t light, float t);
  /// The vertex before the last.
  using Double = BinnedDistance<DoubleScatteringDistance, 8>;
  const Double* dual(size_t light);
  /// The vertex of a forced collision, for a light that single() leaves out. Null where
  /// nothing scatters.
  using Forced = BinnedDistance<CollisionDistance, 32>;
  const Forced* forced(size_t light);
  /// Draws a light for a forced collision.
  std::optional<SelectedLight> select_forced_light(float u);
  float forced_light_probability(size_t light);
  /// The vertex from which a lit point of a surface is seen: equi-angular about it, times
  /// transmittance, phase function and the cosine at the surface. Empty where nothing
  /// scatters.
  using Lit = BinnedDistance<EquiangularSampling, 16>;
  std::optional<Lit> lit(Vec3 p, Vec3 ng, Vec3 to_light) const;
  /// Whether dual(light) can put its first vertex at `x`.
  bool reaches_dual(const LegStart& x, size_t light);

 private:
  // What is known of one light, each once somebody asks.
  struct PerLight {
    size_t light;
    std::optional<EquiangularSampling> base;  // empty where nothing can be aimed at it
    bool varies = false;                      // its distance, enough for single connections
    std::optional<Single> single;
    std::optional<DoubleScatteringDistance> dual_base;
    std::optional<Double> dual;
  };
  PerLight& aim_at(size_t light);
  std::optional<EquiangularSampling> base(size_t light) const;
  bool varies(const PivotSegment& segment) const;
  Single bin_single(size_t light, const EquiangularSampling& base) const;
  const DoubleScatteringDistance* dual_base(size_t light);
  const LightProbabilities& lights();
  const LightProbabilities& forced_lights();
  bool is_homogeneous() const;
  template <int K>
  DistanceWeights<K> weights(const DistanceTaps<K>& taps, bool with_phase) const;

  const ConnectionContext* context_ = nullptr;
  const Pivots* pivots_ = nullptr;
  Ray ray_{};
  LegProxy proxy_;
  bool forces_collisions_ = false;
  float t_max_ = 0;                           // beyond, the proxy lets no light through
  std::optional<LightProbabilities> lights_;  // once somebody asks
  std::optional<LightProbabilities> forced_lights_;
  std::optional<PerLight> cache_;                    // of the light last asked for
  std::optional<std::pair<size_t, Forced>> forced_;  // the same
};

}  // namespace tyndall
