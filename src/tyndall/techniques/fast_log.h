// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace tyndall {

/// ln x for choosing densities by: error below 3e-7 of the larger of one and |ln x|, for
/// normal positive x. Loops over it are vectorised.
inline float fast_log(float x) {
  // x = 2^n m with m in [1/sqrt(2), sqrt(2)): the exponent is counted from the bits of
  // 1/sqrt(2). ln m = 2 artanh z, z = (m - 1) / (m + 1).
  constexpr int32_t root_half = 0x3f3504f3;
  const int32_t bits = std::bit_cast<int32_t>(x);
  const int32_t n = (bits - root_half) >> 23;
  const float m =
      std::bit_cast<float>(bits - static_cast<int32_t>(static_cast<uint32_t>(n) << 23));
  const float z = (m - 1) / (m + 1), z2 = z * z;
  const float half_log_m = z * (1 + z2 * (1.0f / 3 + z2 * (0.2f + z2 * (1.0f / 7))));
  return 2 * half_log_m + static_cast<float>(n) * 0.69314718f;
}

}  // namespace tyndall
