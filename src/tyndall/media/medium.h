// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/media/homogeneous_medium.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/overlapping_media.h"
#include "tyndall/media/rgb_grid_medium.h"

namespace tyndall {

/// A participating medium: properties at a point, and a piecewise constant majorant along a
/// ray. Tracking is not its business; see media/tracking.h. Once it is where it belongs it
/// does not change, and is safe to share between threads.
///
/// Every medium type M of the set provides
///   MediumProperties at(Vec3 p) const;                     p in world space
///   M::Segments segments(Ray ray, float t_max) const;      world space, in order, disjoint
///   bool is_emissive() const;  bool is_grey() const;       grey: all channels equal
///   void move(Vec3d by);                                   to elsewhere in the world
///   size_t memory() const;                                 of its grids [bytes]
///   const PhaseFunction& phase() const;
/// Segments has  bool next(MediumSegment&)  that yields segments until it returns false;
/// what no segment covers is empty space.
using MediumVariant =
    std::variant<HomogeneousMedium, GridMedium, RgbGridMedium, OverlappingMedia>;

class Medium {
 public:
  template <typename M>
  explicit Medium(M medium) : medium_(std::move(medium)) {}

  /// Calls f with the concrete medium: once per ray, so that inner loops are static.
  template <typename F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), medium_);
  }

  /// Moves the medium in world space.
  void move(Vec3d by) {
    std::visit([&](auto& m) { m.move(by); }, medium_);
  }
  MediumProperties at(Vec3 p) const {
    return visit([&](const auto& m) { return m.at(p); });
  }
  bool is_emissive() const {
    return visit([](const auto& m) { return m.is_emissive(); });
  }
  bool is_grey() const {
    return visit([](const auto& m) { return m.is_grey(); });
  }
  bool is_homogeneous() const { return std::holds_alternative<HomogeneousMedium>(medium_); }
  /// Of the grids, which copies share; zero if there are none [bytes].
  size_t memory() const {
    return visit([](const auto& m) { return m.memory(); });
  }
  /// Where media overlap, of one of them: see eval_phase().
  const PhaseFunction& phase() const {
    return visit([](const auto& m) -> const PhaseFunction& { return m.phase(); });
  }

  /// p(wo, wi) at p per channel [1/sr]: the mixture where media overlap.
  Rgb eval_phase(Vec3 p, Vec3 wo, Vec3 wi) const {
    const auto* media = std::get_if<OverlappingMedia>(&medium_);
    return media ? media->eval_phase(p, wo, wi) : Rgb(phase().eval(wo, wi));
  }
  /// Density of sample_phase() [1/sr].
  float pdf_phase(Vec3 p, Vec3 wo, Vec3 wi) const {
    const auto* media = std::get_if<OverlappingMedia>(&medium_);
    return media ? media->pdf_phase(p, wo, wi) : phase().pdf(wo, wi);
  }
  /// Draws wi in proportion to the phase function at p. Empty where nothing scatters.
  std::optional<MediumDirection> sample_phase(Vec3 p, Vec3 wo, Vec2 u) const {
    if (const auto* media = std::get_if<OverlappingMedia>(&medium_))
      return media->sample_phase(p, wo, u);
    const std::optional<PhaseSample> s = phase().sample(wo, u);
    if (!s) return std::nullopt;
    return MediumDirection{s->wi, Rgb(s->value), s->pdf};
  }

 private:
  MediumVariant medium_;
};

}  // namespace tyndall
