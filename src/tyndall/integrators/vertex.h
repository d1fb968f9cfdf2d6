// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "tyndall/sampling/sampler.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// A direction drawn at a vertex.
struct DirectionSample {
  Vec3 wi;    ///< unit, points away from the vertex
  Rgb value;  ///< phase function, or BSDF times cosine [1/sr]
  float pdf;  ///< w.r.t. solid angle [1/sr]
  bool is_specular;
  float eta;  ///< relative index of refraction crossed
};

/// Where a path scatters, in a medium or on a surface; the same questions for both.
class Vertex {
 public:
  /// In a medium.
  Vertex(Vec3 p, Vec3 wo, const Medium* medium);
  /// On a surface; `medium` is the one that light arrived through.
  Vertex(const SurfaceHit& hit, Vec3 wo, const Medium* medium);

  bool is_in_medium() const { return !hit_; }
  Vec3 p() const { return p_; }
  Vec3 wo() const { return wo_; }

  /// Phase function, or BSDF times cosine [1/sr]; zero where it is a Dirac delta.
  Rgb eval(Vec3 wi) const;
  float pdf(Vec3 wi) const;  ///< of sample() w.r.t. solid angle [1/sr]
  /// The same for light that goes the other way: seen from w, arriving from wo().
  Rgb eval_from(Vec3 w) const;
  float pdf_from(Vec3 w) const;
  /// Empty if the light is absorbed.
  std::optional<DirectionSample> sample(Sampler& sampler) const;
  /// No connection can succeed.
  bool is_specular() const;
  Rgb albedo() const;   ///< for the albedo layer
  Vec3 normal() const;  ///< shading normal; zero in a medium

  /// A surface that reflects light from everywhere: connections to what glows can start.
  bool sees_glow() const { return !is_in_medium() && !is_specular(); }
  /// That light arrived through; null in vacuum.
  const Medium* medium() const { return medium_; }
  /// A surface that can be found by rays out of lights.
  bool can_be_lit() const;
  /// Precondition: on a surface.
  const SurfacePoint& point() const { return hit_->point; }
  /// Unit geometric normal; zero in a medium.
  Vec3 ng() const { return hit_ ? hit_->point.ng : Vec3{}; }
  /// The same, on the side of wo().
  Vec3 ng_to_wo() const { return dot(ng(), wo_) < 0 ? -ng() : ng(); }

  /// The ray that leaves towards wi, and the medium it starts in.
  Ray spawn(Vec3 wi) const;
  const Medium* medium_towards(const Scene& scene, Vec3 wi) const;

 private:
  Vec3 p_, wo_;
  const Medium* medium_;
  std::optional<SurfaceHit> hit_;
  std::optional<Bsdf> bsdf_;
};

}  // namespace tyndall
