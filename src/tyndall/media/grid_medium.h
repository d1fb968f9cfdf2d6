// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/brick_grid.h"
#include "tyndall/media/density_bounds.h"
#include "tyndall/media/grid_emission.h"
#include "tyndall/media/grid_placement.h"
#include "tyndall/media/grid_walk.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/phase_function.h"
#include "tyndall/media/placed_grid.h"

namespace tyndall {

/// A density grid that scales constant coefficients, trilinear between samples; what pbrt
/// calls "uniformgrid", "nanovdb" and, tabulated, "cloud" [PBRT4, Sec. 11.4]. Shares its
/// grids with its copies.
class GridMedium {
 public:
  /// `density` scales the coefficients and `emission` varies Le = properties.Le.
  GridMedium(const PlacedGrid& density, const Transform& world_from_medium,
             const MediumProperties& properties, PhaseFunction phase,
             const GridEmission& emission = {});
  /// place_in_box(density, bounds), with constant emission.
  GridMedium(const DensityGrid& density, const Bounds3& bounds,
             const Transform& world_from_medium, const MediumProperties& properties,
             PhaseFunction phase);

  /// DDA over majorants and means, empty cells skipped.
  class Segments {
   public:
    Segments(const GridMedium& medium, const Ray& ray, float t_max)
        : medium_(&medium),
          world_ray_(ray),
          walk_(*medium.bounds_, medium.placement_.clip(ray, t_max)) {}

    [[gnu::always_inline]] bool next(MediumSegment& segment) {
      GridWalk<1>::Stretch stretch;
      if (!walk_.next(stretch)) return false;
      majorant_ = stretch.cell[0].majorant;
      segment = {stretch.t_min, stretch.t_max, medium_->sigma_t_ * majorant_,
                 medium_->sigma_t_ * stretch.cell[0].mean};
      return true;
    }

    /// The medium at a distance in the last segment; never above its majorant.
    MediumProperties at(float t) const {
      return medium_->properties(std::min(unbounded(t), majorant_), world_ray_.at(t));
    }
    Rgb sigma_t(float t) const {
      return medium_->sigma_t_ * std::min(unbounded(t), majorant_);
    }

    /// Extinction at any distance along the ray, in any order.
    Rgb sigma_t_anywhere(float t) const { return medium_->sigma_t_ * density(t); }
    float density(float t) const { return std::min(unbounded(t), medium_->largest_); }

   private:
    float unbounded(float t) const { return medium_->density(walk_.p_grid(t)); }

    const GridMedium* medium_;
    Ray world_ray_;
    float majorant_ = 0;  // of the density in the last segment
    GridWalk<1> walk_;
  };

  MediumProperties at(Vec3 p) const {
    return properties(std::min(density(placement_.point(p)), largest_), p);
  }
  Segments segments(const Ray& ray, float t_max) const { return {*this, ray, t_max}; }
  bool is_emissive() const { return !is_black(properties_.sigma_a * properties_.Le); }
  bool is_grey() const {
    return tyndall::is_grey(properties_.sigma_a) && tyndall::is_grey(properties_.sigma_s);
  }
  void move(Vec3d by);  ///< in the world
  const PhaseFunction& phase() const { return phase_; }
  /// Whether there are densities so large that they were reduced: to an optical depth of
  /// 1e6 from one sample to the next. Nothing is seen of that, but walks end.
  bool is_reduced() const { return density_->maximum() > largest_; }
  size_t memory() const {
    return density_->memory() + bounds_->memory() + (emission_ ? emission_->memory() : 0);
  }
  Bounds3 world_bounds() const { return placement_.world_bounds(); }
  const GridPlacement& placement() const { return placement_; }

 private:
  float density(Vec3 p_grid) const {
    return placement_.contains(p_grid) ? density_->interpolate(p_grid) : 0;
  }
  MediumProperties properties(float density, Vec3 p) const {
    const bool varies = emission_ && density > 0;
    return {properties_.sigma_a * density, properties_.sigma_s * density,
            varies ? properties_.Le * emission_->factor(p) : properties_.Le};
  }

  std::shared_ptr<const BrickGrid> density_;
  std::shared_ptr<const DensityBounds<1>> bounds_;
  std::shared_ptr<const EmissionLookup> emission_;  // null if constant
  GridPlacement placement_;
  MediumProperties properties_;
  Rgb sigma_t_;
  float largest_;  // density that is met
  PhaseFunction phase_;
};

}  // namespace tyndall
