// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/constants.h"
#include "tyndall/math/rgb.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/media/homogeneous_medium.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/rgb_grid_medium.h"

namespace tyndall {

/// A medium that does not consist of others.
using SingleMedium = std::variant<HomogeneousMedium, GridMedium, RgbGridMedium>;

/// A direction drawn from a medium's phase function at a point.
struct MediumDirection {
  Vec3 wi;    ///< unit, points away from the scattering point
  Rgb value;  ///< p(wo, wi) per channel [1/sr]
  float pdf;  ///< density of wi w.r.t. solid angle [1/sr]
};

/// Several media in the same place: their coefficients and emission add up, and each
/// scatters by its own phase function.
class OverlappingMedia {
 public:
  /// Precondition: not empty.
  explicit OverlappingMedia(std::vector<SingleMedium> parts) : parts_(std::move(parts)) {}

  /// The parts' segments, cut where any of them begins or ends.
  class Segments {
   public:
    Segments(const OverlappingMedia& media, const Ray& ray, float t_max);
    bool next(MediumSegment& segment);
    /// The medium at a distance in the last segment; never above its majorant.
    MediumProperties at(float t) const;
    Rgb sigma_t(float t) const;
    /// Extinction at any distance along the ray, in any order.
    Rgb sigma_t_anywhere(float t) const;

   private:
    using Walk = std::variant<HomogeneousMedium::Segments, GridMedium::Segments,
                              RgbGridMedium::Segments>;
    struct Part {
      Walk walk;
      MediumSegment segment;
      bool has_segment;     // and not beyond its last one
      bool meets_anything;  // had a segment at all
      bool is_active;       // in the last segment of all
    };

    boost::container::small_vector<Part, 2> parts_;
    float t_ = 0;
  };

  void move(Vec3d by) {
    for (SingleMedium& part : parts_) std::visit([&](auto& m) { m.move(by); }, part);
  }
  MediumProperties at(Vec3 p) const;
  Segments segments(const Ray& ray, float t_max) const { return {*this, ray, t_max}; }
  bool is_emissive() const;
  bool is_grey() const;
  size_t memory() const { return 0; }  ///< the grids belong to the parts' originals

  /// The mixture of the phase functions at p, by scattering coefficients, per channel
  /// [1/sr]; black where nothing scatters.
  Rgb eval_phase(Vec3 p, Vec3 wo, Vec3 wi) const;
  float pdf_phase(Vec3 p, Vec3 wo, Vec3 wi) const;  ///< of sample_phase() [1/sr]
  /// A direction drawn from the phase function of one of the parts at p, and its density in
  /// the mixture. Empty where nothing scatters.
  std::optional<MediumDirection> sample_phase(Vec3 p, Vec3 wo, Vec2 u) const;
  /// Of one of the parts: what techniques that need one phase function take for all.
  const PhaseFunction& phase() const;
  const std::vector<SingleMedium>& parts() const { return parts_; }

 private:
  std::vector<SingleMedium> parts_;
};

}  // namespace tyndall
