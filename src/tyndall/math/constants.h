// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace tyndall {

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr float inv_pi = 0.31830988618379067154f;
inline constexpr float inv_4pi = 0.07957747154594766788f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// The largest float below one: an upper bound for uniform numbers in [0, 1).
inline constexpr float one_minus_epsilon = 0x1.fffffep-1f;

}  // namespace tyndall
