// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace tyndall {

/// exp(x) for x <= 0, written so that compilers vectorize loops over it.
///
/// Relative error below 2e-7 for x in [-80, 0]; below -80 the result stays at exp(-80),
/// about 1.8e-35, so that a density built from it is positive everywhere and never
/// denormal.
inline float exp_nonpositive(float x) {
  x = x < -80.0f ? -80.0f : x;
  // x = n ln 2 + f with |f| <= ln(2) / 2. Adding 1.5 * 2^23 rounds to the nearest integer
  // and leaves it in the low bits; ln 2 in two parts keeps f exact.
  const float shifted = x * 1.44269504f + 12582912.0f;
  const float n = shifted - 12582912.0f;
  const float f = (x - n * 0.693359375f) - n * -2.12194440e-4f;
  // Chebyshev fit of (exp(f) - 1 - f) / f^2 on that interval.
  const float q =
      0.5f +
      f * (0.166665766f + f * (0.0416664642f + f * (0.00836323538f + f * 0.00139337332f)));
  const float e = 1 + (f + f * f * q);
  // 2^n: the integer sits in the low bits of `shifted`, offset by the bits of 1.5 * 2^23.
  const uint32_t bits = (std::bit_cast<uint32_t>(shifted) - 0x4b400000u + 127u) << 23;
  return e * std::bit_cast<float>(bits);
}

}  // namespace tyndall
