// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "tyndall/geometry/cell_walk.h"
#include "tyndall/geometry/grid_space.h"
#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/brick_grid.h"
#include "tyndall/media/grid_emission.h"
#include "tyndall/media/majorant_grid.h"
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

  /// DDA over a coarse grid of majorants and means, empty cells skipped.
  class Segments {
   public:
    Segments(const GridMedium& medium, const Ray& ray, float t_max)
        : medium_(&medium), world_ray_(ray) {
      const auto clip = medium.space_.clip(ray, t_max, medium.box_);
      if (!clip) return;
      ray_ = clip->ray;
      t_offset_ = clip->t_offset;
      walk_ = medium.majorants_->walk(ray_, clip->length);
    }

    bool next(MediumSegment& segment) {
      if (among_samples_) [[unlikely]]
        if (next_among_samples(segment)) return true;
      CellWalk::Step step;
      while (walk_.next(step)) {
        const MajorantCell& cell = medium_->majorants_->cell(step.cell);
        if (cell.majorant == 0) continue;
        if (medium_->is_rough(cell, step.t_max - step.t_min)) [[unlikely]] {
          look_closer(step);
          if (next_among_samples(segment)) return true;
          continue;
        }
        take(cell, step, segment);
        return true;
      }
      return false;
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
    float unbounded(float t) const { return medium_->density(ray_.at(t - t_offset_)); }
    void take(const MajorantCell& cell, const CellWalk::Step& step,
              MediumSegment& segment) {
      majorant_ = std::min(cell.majorant, medium_->largest_);
      segment = {t_offset_ + step.t_min, t_offset_ + step.t_max,
                 medium_->sigma_t_ * majorant_,
                 medium_->sigma_t_ * std::min(cell.mean, majorant_)};
    }
    void look_closer(const CellWalk::Step& step);
    bool next_among_samples(MediumSegment& segment);

    const GridMedium* medium_;
    Ray world_ray_;
    GridRay ray_;
    float t_offset_ = 0;
    float majorant_ = 0;  // of the density in the last segment
    CellWalk walk_;
    std::optional<CellWalk> among_samples_;  // on the way through a rough cell
  };

  MediumProperties at(Vec3 p) const {
    return properties(std::min(density(space_.point(p)), largest_), p);
  }
  Segments segments(const Ray& ray, float t_max) const { return {*this, ray, t_max}; }
  bool is_emissive() const { return !is_black(properties_.sigma_a * properties_.Le); }
  bool is_grey() const {
    return tyndall::is_grey(properties_.sigma_a) && tyndall::is_grey(properties_.sigma_s);
  }
  void move(Vec3d by);  ///< in the world
  const PhaseFunction& phase() const { return phase_; }
  /// Whether there are densities so large that they were reduced: to an optical depth of
  /// 1e12 from one sample to the next. Nothing is seen of that, but walks end.
  bool is_reduced() const { return density_->maximum() > largest_; }
  size_t memory() const {
    return density_->memory() + majorants_->memory() +
           (emission_ ? emission_->memory() : 0);
  }
  /// Of the box; empty if the medium is.
  Bounds3 world_bounds() const { return world_bounds_; }
  /// Where the medium is, in the space of its samples; empty if it is nowhere.
  const Bounds3& grid_box() const { return box_; }
  const Transform& world_from_grid() const { return world_from_grid_; }

 private:
  float density(Vec3 p_grid) const {
    return box_.contains(p_grid) ? density_->interpolate(p_grid) : 0;
  }
  /// Whether a ray over this length of the cell would meet its majorant so often, and
  /// mostly in vain, that bounds of their own for all samples are worth finding.
  bool is_rough(const MajorantCell& cell, float length) const {
    constexpr float in_vain = 8;
    return cell.majorant * length > rough_ && cell.majorant > in_vain * cell.mean;
  }
  MediumProperties properties(float density, Vec3 p) const {
    const bool varies = emission_ && density > 0;
    return {properties_.sigma_a * density, properties_.sigma_s * density,
            varies ? properties_.Le * emission_->factor(p) : properties_.Le};
  }

  std::shared_ptr<const BrickGrid> density_;
  std::shared_ptr<const MajorantGrid> majorants_;
  std::shared_ptr<const EmissionLookup> emission_;  // null if constant
  Transform world_from_grid_;
  GridSpace space_;
  Bounds3 box_;  // in grid space
  Bounds3 world_bounds_;
  MediumProperties properties_;
  Rgb sigma_t_;
  float largest_ = infinity;
  float rough_ = infinity;  // densities times lengths from which cells may be rough
  PhaseFunction phase_;
};

}  // namespace tyndall
