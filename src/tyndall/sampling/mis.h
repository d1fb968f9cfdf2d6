// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tyndall/math/constants.h"

namespace tyndall {

/// The weight of a sample drawn with density `pdf` that another technique would have drawn
/// with density `other`, in the same measure [Veach97, Sec. 9.2]. Densities may be
/// infinite; two infinite ones count as equal. Zero where pdf is zero.
constexpr float balance_heuristic(float pdf, float other) {
  if (!(pdf > 0)) return 0;
  if (pdf == infinity) return other == infinity ? 0.5f : 1;
  return 1 / (1 + other / pdf);  // a ratio that overflows has the right limit
}

/// The same with the squares of the densities.
constexpr float power_heuristic(float pdf, float other) {
  if (!(pdf > 0)) return 0;
  if (pdf == infinity) return other == infinity ? 0.5f : 1;
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

}  // namespace tyndall
