// SPDX-License-Identifier: Apache-2.0
#include "tyndall/geometry/area_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/math/constants.h"

namespace tyndall {

void AreaTable::append(double area) {
  sums_.push_back(total() + (std::isfinite(area) ? area : 0));
}

PrimitiveChoice AreaTable::choose(float u) const {
  assert(total() > 0);
  const double target = static_cast<double>(u) * total();
  // The first sum above the target belongs to a primitive that has an area.
  auto it = std::upper_bound(sums_.begin(), sums_.end(), target);
  if (it == sums_.end()) it = std::lower_bound(sums_.begin(), sums_.end(), total());
  const double before = it == sums_.begin() ? 0 : *(it - 1);
  const auto remapped = static_cast<float>((target - before) / (*it - before));
  return {.primitive = static_cast<uint32_t>(it - sums_.begin()),
          .u_remapped = std::clamp(remapped, 0.0f, one_minus_epsilon)};
}

}  // namespace tyndall
