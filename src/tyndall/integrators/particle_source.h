// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tyndall/guiding/learned_squares.h"
#include "tyndall/integrators/emission_square.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// A particle that leaves a light.
struct EmittedParticle {
  Ray ray;
  const Medium* medium;  ///< around the start
  Rgb beta;              ///< flux over the density of the ray
  float density;         ///< ParticleSource::density() of the ray
};

/// The start of particles that fly to surfaces that reflect or refract like a mirror: the
/// light, and where and which way it emits, are chosen by what a few thousand rays have
/// met, which are traced by the constructor. Environments and glowing media emit none.
class ParticleSource {
 public:
  /// Throws nothing; `scene` must outlive it.
  ParticleSource(const Scene& scene, uint64_t seed);

  /// Whether particles would reach anything specular at all.
  bool is_useful() const { return is_useful_; }
  /// Empty if nothing is emitted there.
  std::optional<EmittedParticle> emit(float u_light, Vec2 u_direction, Vec2 u_point) const;
  /// Density of emit() for a point `p` of a light and the unit direction `w` out of it,
  /// w.r.t. area and projected solid angle [1/(sr unit^2)]; infinite for lights that no
  /// walk can hit, zero for those that emit no particles.
  float density(size_t light, Vec3 w, Vec3 p) const;

  /// A surface from which particles go on to anything else.
  static bool is_specular(const Surface& surface);

 private:
  struct Emitter {
    std::optional<EmissionSquare> square;  // empty: emits none
    std::array<const Medium*, 2> media{};  // in front and behind
    bool is_hit_by_walks = false;
  };
  void add_emitters();
  void find_media(Emitter& emitter, bool is_infinite) const;
  void learn(uint64_t seed, float power);  // of all emitters
  std::optional<EmittedRay> emit(const SquaresSample& choice, Vec2 u_point) const;

  const Scene* scene_;
  std::vector<Light> lights_;  // hidden area lights as if they were not
  std::vector<Emitter> emitters_;
  std::optional<LearnedSquares> learned_;
  bool is_useful_ = false;
};

}  // namespace tyndall
