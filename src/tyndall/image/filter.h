// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tyndall/math/vec.h"
#include "tyndall/sampling/tabulated.h"

namespace tyndall {

enum class FilterKind { box, triangle, gaussian, mitchell };

struct FilterSettings {
  FilterKind kind = FilterKind::gaussian;
  Vec2 radius{1.5f, 1.5f};        ///< [pixels]
  float sigma = 0.5f;             ///< gaussian [pixels]
  float b = 1.0f / 3, c = 1.0f / 3;  ///< mitchell
};

/// An offset from the pixel's centre, drawn from a filter.
struct FilterSample {
  Vec2 offset;   ///< [pixels]
  float weight;  ///< filter value over its density, 1 on average; negative in negative lobes
};

/// A pixel reconstruction filter that is sampled, so that each sample belongs to one pixel
/// [Ernst06].
class Filter {
 public:
  explicit Filter(const FilterSettings& settings);

  float eval(Vec2 offset) const;
  FilterSample sample(Vec2 u) const;

 private:
  FilterSettings settings_;
  PiecewiseConstant2D distribution_;
  float mean_sign_ = 1;  // integral of f over integral of |f|
};

}  // namespace tyndall
