// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace tyndall {

/// e^x for choosing densities by: relative error below 4e-6 for |x| < 85, clamped beyond,
/// so positive and finite whatever x is. Loops over it are vectorised.
inline float fast_exp(float x) {
  // 2^y with y = n + f, |f| <= 1/2. Adding the large number leaves n in its low bits, which
  // go into the exponent of a polynomial in f.
  const float scaled = x * 1.44269504f;
  const float above = scaled > -123 ? scaled : -123;
  const float y = above < 123 ? above : 123;
  const float rounded = y + 12582912.0f;
  const float f = y - (rounded - 12582912.0f);
  const float p =
      0.999999261f +
      f * (0.693121815f + f * (0.240247449f + f * (0.05591786f + f * 0.009570101f)));
  return std::bit_cast<float>(std::bit_cast<int32_t>(p) +
                              static_cast<int32_t>(std::bit_cast<uint32_t>(rounded) << 23));
}

}  // namespace tyndall
