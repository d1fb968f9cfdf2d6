// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/bounds.h"
#include "tyndall/math/rgb.h"
#include "tyndall/math/transform.h"
#include "tyndall/media/brick_grid.h"
#include "tyndall/media/density_bounds.h"
#include "tyndall/media/grid_placement.h"
#include "tyndall/media/grid_walk.h"
#include "tyndall/media/medium_properties.h"
#include "tyndall/media/phase_function.h"

namespace tyndall {

/// Colours at cell centres of a box, x fastest, then y, then z.
struct RgbGrid {
  Vec3i resolution;
  std::vector<Rgb> values;  ///< resolution.x * y * z of them
};

/// A medium whose coefficients are colours that vary freely: pbrt's "rgbgrid" [PBRT4,
/// Sec. 11.4].
class RgbGridMedium {
 public:
  /// What the medium is made of, each optional: coefficients that are not given are one.
  struct Grids {
    std::optional<RgbGrid> sigma_a, sigma_s;
    std::optional<RgbGrid> Le;
  };

  /// `scale` multiplies the coefficients, `Le_scale` the emission. Precondition: all grids
  /// have the same resolution, and there is one of a coefficient.
  RgbGridMedium(const Grids& grids, const Bounds3& bounds,
                const Transform& world_from_medium, float scale, float Le_scale,
                PhaseFunction phase);

  /// DDA over the channels' majorants and means, empty cells skipped.
  class Segments {
   public:
    Segments(const RgbGridMedium& medium, const Ray& ray, float t_max)
        : medium_(&medium), walk_(*medium.bounds_, medium.placement_.clip(ray, t_max)) {}

    bool next(MediumSegment& segment) {
      GridWalk<3>::Stretch stretch;
      if (!walk_.next(stretch)) return false;
      const auto& [r, g, b] = stretch.cell;
      majorant_ = {r.majorant, g.majorant, b.majorant};
      segment = {stretch.t_min, stretch.t_max, majorant_, {r.mean, g.mean, b.mean}};
      return true;
    }

    /// The medium at a distance in the last segment; never above its majorant.
    MediumProperties at(float t) const {
      return medium_->properties(walk_.p_grid(t), majorant_);
    }
    Rgb sigma_t(float t) const { return min(sigma_t_anywhere(t), majorant_); }
    /// Extinction at any distance along the ray, in any order.
    Rgb sigma_t_anywhere(float t) const { return medium_->sigma_t(walk_.p_grid(t)); }

   private:
    const RgbGridMedium* medium_;
    Rgb majorant_;
    GridWalk<3> walk_;
  };

  MediumProperties at(Vec3 p) const {
    return properties(placement_.point(p), Rgb(infinity));
  }
  Segments segments(const Ray& ray, float t_max) const { return {*this, ray, t_max}; }
  bool is_emissive() const { return Le_ != nullptr; }
  bool is_grey() const { return false; }
  void move(Vec3d by) { placement_.move(by); }  ///< in the world
  const PhaseFunction& phase() const { return phase_; }
  /// Whether there are coefficients so large that they were reduced, as those of
  /// GridMedium::is_reduced().
  bool is_reduced() const { return is_reduced_; }
  size_t memory() const {
    return sigma_t_->memory() + sigma_s_->memory() + (Le_ ? Le_->memory() : 0) +
           bounds_->memory();
  }
  Bounds3 world_bounds() const { return placement_.world_bounds(); }
  const GridPlacement& placement() const { return placement_; }

 private:
  // One sparse grid per channel.
  struct Field {
    BrickGrid r, g, b;

    Rgb operator()(Vec3 p_grid) const {
      return {r.interpolate(p_grid), g.interpolate(p_grid), b.interpolate(p_grid)};
    }
    size_t memory() const { return r.memory() + g.memory() + b.memory(); }
  };

  static std::shared_ptr<const Field> make_field(const RgbGrid& grid);
  static Rgb min(Rgb a, Rgb b) {
    return {std::min(a.r, b.r), std::min(a.g, b.g), std::min(a.b, b.b)};
  }
  Rgb sigma_t(Vec3 p_grid) const {
    return placement_.contains(p_grid) ? (*sigma_t_)(p_grid) : Rgb(0);
  }
  MediumProperties properties(Vec3 p_grid, Rgb majorant) const {
    if (!placement_.contains(p_grid)) return {};
    const Rgb sum = min((*sigma_t_)(p_grid), majorant);
    const Rgb sigma_s = min((*sigma_s_)(p_grid), sum);
    return {sum - sigma_s, sigma_s, Le_ ? (*Le_)(p_grid) : Rgb(0)};
  }

  std::shared_ptr<const Field> sigma_t_, sigma_s_;
  std::shared_ptr<const Field> Le_;  // null if dark
  std::shared_ptr<const DensityBounds<3>> bounds_;
  bool is_reduced_ = false;
  GridPlacement placement_;
  PhaseFunction phase_;
};

}  // namespace tyndall
