// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tyndall/guiding/learned_squares.h"
#include "tyndall/integrators/emission_square.h"
#include "tyndall/sampling/random.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// The most surfaces by way of which light walks to a lit point, that point included.
inline constexpr int max_lit_surfaces = 4;

/// The area densities with which a walk goes from each of some surfaces to the next, the
/// surface nearest the light first: edge[0] is that of the first lit surface as seen from
/// the vertex before it on the camera's side [1/scene unit^2].
struct LitChain {
  std::array<float, max_lit_surfaces> edge{};
  int size = 0;
  /// The last edge starts at a vertex in a medium, which a connection would put on a leg.
  bool is_seen_from_leg = false;

  void push_front(float density);
  void push_back(float density);
};

/// A surface point that a light shines on, by way of other surfaces or directly,
/// found by a walk out of the light: bright surfaces near a lamp are found as often as they
/// are bright, where a walk from the camera hardly ever meets them.
struct LitPoint {
  /// A straight part of the walk, backwards: from a surface to what came before.
  struct Edge {
    Ray ray;
    float length;
  };

  SurfaceHit hit;
  /// What arrives at the point, over the density of the walk: emission times reflectances;
  /// transmittances and what the point itself does are left out.
  Rgb flux;
  int surfaces = 1;  ///< that the walk met, this one included
  std::array<Edge, max_lit_surfaces>
      edge{};        ///< from each of them, nearest the light first
  LitChain chain;    ///< between them
  SurfaceHit first;  ///< the surface nearest the light
  size_t light;
  SurfacePoint on_light;  ///< of area lights
  SquaresSample choice;   ///< of the light, the number of surfaces, and the direction

  Vec3 to_previous() const { return edge[surfaces - 1].ray.d; }
  Vec3 to_light() const { return edge[0].ray.d; }
};

/// Walks out of lights, but for environments, over surfaces that reflect diffusely, in
/// directions that were worth most so far: the light, the number of surfaces and the
/// direction are chosen by what earlier points have contributed, at first by power and
/// evenly into the light's cone; from area lights by area and cosine. What is seen differs:
/// it is learned for each of some places that connections start from.
///
/// record() may be called from many threads; update() from one, while nothing else is
/// called.
class LitSurfaceSampling {
 public:
  /// `max_surfaces` in [1, max_lit_surfaces] bounds the walks.
  /// Places are numbered from zero; at least one.
  LitSurfaceSampling(const Scene& scene, int max_surfaces, size_t places = 1);

  /// Whether surfaces like this are found: those that reflect light diffusely.
  static bool finds(const Surface& surface);
  /// Empty if the walk meets no surface that reflects light diffusely.
  std::optional<LitPoint> sample(size_t place, float u_choice, Vec2 u_point,
                                 Vec2 u_direction, RandomStream& rng) const;

  /// Where walks over 1, 2 ... surfaces are connected to from.
  using Places = std::array<size_t, max_lit_surfaces>;
  /// The densities of the first surface of walks over 1, 2 ... surfaces, for a point `p` at
  /// `distance` from the light, which lies in the unit direction `to_light` under an angle
  /// of cosine `cos_light`: w.r.t. area, up to the factor that turns the solid angle of
  /// next event estimation from there into the light's area (one if it is a delta).
  std::array<float, max_lit_surfaces> densities(const Places& places, size_t light, Vec3 p,
                                                Vec3 to_light, float distance,
                                                float cos_light) const;

  /// The point has added `value` to a pixel, in units of the mean pixel.
  void record(size_t place, const LitPoint& lit, float value) const {
    whole_.record(lit.choice, value);
    if (!places_.empty()) places_[place].record(lit.choice, value);
  }
  /// Learns from what was recorded so far.
  void update();
  size_t memory() const;  ///< [bytes]

 private:
  const LearnedSquares& at(size_t place) const {
    return places_.empty() ? whole_ : places_[place];
  }
  bool bounce(LitPoint& lit, RandomStream& rng) const;
  bool go(LitPoint& lit, const Ray& ray) const;

  const Scene* scene_;
  int max_surfaces_;
  std::vector<std::optional<EmissionSquare>> squares_;  // none for environments
  // Squares of each light in turn, for each number of surfaces.
  LearnedSquares whole_;
  std::vector<LearnedSquares> places_;  // empty if there is one, or too much to learn
};

/// Density with which a walk goes from one diffuse surface to another, w.r.t. the area of
/// the second; the same in both directions.
float diffuse_edge_density(Vec3 ng0, Vec3 ng1, Vec3 w, float distance);

}  // namespace tyndall
