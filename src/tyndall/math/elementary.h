// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "tyndall/math/constants.h"

namespace tyndall {

// Elementary functions in float without calls, tables or jumps, right to 2.5e-7: for
// densities that are both drawn from and returned. Arguments that are no numbers, or
// outside of the ranges given, lead to numbers without meaning, or to none.

/// `negative` if the sign bit of x is set, else `positive`; never a jump, which would be
/// mispredicted half of the time.
inline float by_sign(float x, float positive, float negative) {
  const uint32_t mask = 0 - (std::bit_cast<uint32_t>(x) >> 31);
  const auto a = std::bit_cast<uint32_t>(positive), b = std::bit_cast<uint32_t>(negative);
  return std::bit_cast<float>(a ^ ((a ^ b) & mask));
}

/// x, with its sign changed for each of a and b that has its sign bit set.
inline float flip_sign(float x, float a, float b) {
  const uint32_t sign = std::bit_cast<uint32_t>(a) ^ std::bit_cast<uint32_t>(b);
  return std::bit_cast<float>(std::bit_cast<uint32_t>(x) ^ (sign & 0x80000000u));
}

/// atan(x) / x for x in [-1, 1].
inline float arc_tangent_over(float x) {
  const float a = x * x, a2 = a * a;
  const float low =
      (-0.333331525f + 0.199937731f * a) + (-0.142110556f + 0.106660038f * a) * a2;
  const float high =
      (-0.0755221248f + 0.0432118364f * a) + (-0.0163679142f + 0.0029206886f * a) * a2;
  return 1 + a * (low + high * (a2 * a2));
}

/// atan(x) for x in [-1, 1].
inline float arc_tangent(float x) { return x * arc_tangent_over(x); }

/// The angles of a vector from the z axis and from its opposite [rad].
struct PolarAngle {
  float theta, back;  ///< each with all digits where it is small
};

/// Of a vector with `run` along the axis and `rise` >= 0 across it, of any length; that of
/// the vector zero is along the axis.
inline PolarAngle polar_angle(float run, float rise) {
  const float along = std::abs(run), large = std::max(along, rise);
  const float arc = large > 0 ? arc_tangent(std::min(along, rise) / large) : 0;
  const float acute = rise > along ? 0.5f * pi - arc : arc;
  return {by_sign(run, acute, pi - acute), by_sign(run, pi - acute, acute)};
}

/// sin(x) / x by the square of x, x in [0, pi / 2].
inline float sine_over(float square) {
  const float a = square, a2 = a * a;
  return 1 + a * ((-0.166666597f + 0.00833306648f * a) +
                  (-0.000198095964f + 2.60576576e-6f * a) * a2);
}

/// cos(x) by the square of x, x in [0, pi / 2]; right to 1e-7, not of itself but of one.
inline float cosine_by_square(float square) {
  const float a = square, a2 = a * a;
  return 1 + a * ((-0.5f + 0.0416666418f * a) +
                  a2 * ((-0.00138884038f + 2.47618791e-5f * a) - 2.6076961e-7f * a2));
}

struct SineCosine {
  float sine, cosine;
};

/// Of 2 pi x for x in [0, 1]; right to 1e-7 of one, and the sine of small x of itself.
inline SineCosine sine_cosine_of_turns(float x) {
  // The number of quarters is left in the low bits of a large number.
  const float quarters = 4 * x, rounded = quarters + 12582912.0f;
  const float f = quarters - (rounded - 12582912.0f), a = f * f, a2 = a * a;
  const float sine =
      f * ((1.57079637f - 0.64596349f * a) + (0.079680033f - 0.00460165786f * a) * a2);
  const float cosine = 1 + a * ((-1.23370051f + 0.253669232f * a) +
                                (-0.0208601654f + 0.000903766544f * a) * a2);
  const auto n = std::bit_cast<uint32_t>(rounded);
  const auto s = std::bit_cast<uint32_t>(sine), c = std::bit_cast<uint32_t>(cosine);
  const uint32_t swap = (s ^ c) & (0 - (n & 1));
  return {std::bit_cast<float>((s ^ swap) ^ ((n & 2) << 30)),
          std::bit_cast<float>((c ^ swap) ^ (((n + 1) & 2) << 30))};
}

/// e^x - 1 for x in [0, 88.7].
inline float exp_minus_1(float x) {
  const float rounded = x * 1.44269504f + 12582912.0f, n = rounded - 12582912.0f;
  const float f = (x - n * 0.693359375f) + n * 2.12194440e-4f, f2 = f * f;
  const float p =
      f + f2 * ((0.49999997f + 0.166665435f * f) +
                f2 * ((0.0416672006f + 0.00836658012f * f) + 0.00138825097f * f2));
  // Half of 2^n, which itself may be too large.
  const auto half = std::bit_cast<float>((std::bit_cast<uint32_t>(rounded) + 126) << 23);
  return 2 * (half * p + (half - 0.5f));
}

/// n ln 2 + ln(1 + f) for f in [1/sqrt(2) - 1, sqrt(2) - 1].
inline float log_of_parts(float n, float f) {
  const float z = f / (2 + f), a = z * z;
  const float log_f =
      2 * z * (1 + a * (0.33333388f + a * (0.199887767f + a * 0.149357602f)));
  return n * 0.693359375f + (log_f - n * 2.12194440e-4f);
}

/// ln x for normal positive x.
inline float log_of(float x) {
  constexpr uint32_t root_half = 0x3f3504f3;
  const auto bits = std::bit_cast<uint32_t>(x);
  const auto n = static_cast<int32_t>(bits - root_half) >> 23;
  const auto m = std::bit_cast<float>(bits - (static_cast<uint32_t>(n) << 23));
  return log_of_parts(static_cast<float>(n), m - 1);
}

/// ln(1 + x) for finite x >= 0, with all digits of small x.
inline float log_of_1_plus(float x) {
  const float sum = 1 + x, part = sum - x;
  const float lost = (x - (sum - part)) + (1 - part);  // by rounding the sum, exactly
  constexpr uint32_t root_half = 0x3f3504f3;
  const auto bits = std::bit_cast<uint32_t>(sum);
  const uint32_t n = (bits - root_half) >> 23;
  const auto m = std::bit_cast<float>(bits - (n << 23));
  const auto scale = std::bit_cast<float>((127 - n) << 23);
  return log_of_parts(static_cast<float>(n), (m - 1) + lost * scale);
}

}  // namespace tyndall
