// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tyndall/math/vec.h"
#include "tyndall/sampling/tabulated.h"

namespace tyndall {

enum class FilterKind { box, triangle, gaussian, mitchell };

struct FilterSettings {
  FilterKind kind = FilterKind::gaussian;
  Vec2 radius{1.5f, 1.5f};           ///< [pixels]
  float sigma = 0.5f;                ///< gaussian [pixels]
  float b = 1.0f / 3, c = 1.0f / 3;  ///< mitchell
};

/// An offset from the pixel's centre, drawn from a filter.
struct FilterSample {
  Vec2 offset;  ///< [pixels]
  float
      weight;  ///< filter value over its density, 1 on average; negative in negative lobes
};

/// A separable pixel reconstruction filter that is sampled, so that each sample belongs to
/// one pixel [Ernst06]. Samples follow |f|; their weight is constant but for its sign.
///
/// The gaussian is lowered by its value at the radius, so that it ends at zero; the
/// mitchell filter [Mitchell88] is stretched to the radius. Both as in [PBRT4, Sec. 8.8].
class Filter {
 public:
  /// Precondition: the radius, and a gaussian's sigma, are positive.
  explicit Filter(const FilterSettings& settings);

  /// Not normalised: only the shape means something. Zero outside the radius.
  float eval(Vec2 offset) const;
  FilterSample sample(Vec2 u) const;
  /// What samples weigh around an offset: their density times their weight, whose integral
  /// is one [1/pixel^2].
  float density(Vec2 offset) const;
  Vec2 radius() const { return settings_.radius; }  ///< [pixels]

 private:
  // One factor f(x) of the product, tabulated over [-radius, radius].
  struct Axis {
    PiecewiseConstant1D distribution;  // of |f|
    std::vector<bool> is_negative;     // by bin
    float weight = 1;                  // integral of |f| over integral of f

    bool is_negative_at(float x) const;
  };
  double eval_axis(double x, double radius) const;
  Axis make_axis(double radius) const;

  FilterSettings settings_;
  Axis x_, y_;
};

}  // namespace tyndall
