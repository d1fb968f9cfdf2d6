// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "tyndall/math/constants.h"

namespace tyndall {

template <typename T>
requires std::is_arithmetic_v<T>
constexpr T sqr(T x) { return x * x; }

/// Square root that takes the small negative numbers of rounding as zero.
inline float safe_sqrt(float x) { return std::sqrt(std::max(x, 0.0f)); }

constexpr float radians(float degrees) { return degrees * (pi / 180); }
constexpr float degrees(float radians) { return radians * (180 / pi); }

/// x without its sign; usable in constant expressions.
constexpr float magnitude(float x) { return x < 0 ? -x : x; }

/// a / b, or zero where b is zero.
constexpr float safe_divide(float a, float b) { return b != 0 ? a / b : 0; }

}  // namespace tyndall
