// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace tyndall {

/// e^x for choosing densities by: relative error below 3e-6 for |x| < 87, clamped beyond, so
/// always positive and finite (NaN gives some number in range). Loops over it are vectorised.
inline float fast_exp(float x) {
  // 2^y with y = n + f, |f| <= 1/2: n goes into the exponent, a polynomial takes f.
  float y = x * 1.44269504f;
  y = y > -125 ? y : -125;
  y = y < 125 ? y : 125;
  const auto n = static_cast<int32_t>(y + 256.5f) - 256;
  const float f = y - static_cast<float>(n);
  const float p =
      1.0f +
      f * (0.693147182f +
           f * (0.240226462f + f * (0.0555033116f + f * (0.00961806f + f * 0.00133336f))));
  return p * std::bit_cast<float>((n + 127) << 23);
}

}  // namespace tyndall
