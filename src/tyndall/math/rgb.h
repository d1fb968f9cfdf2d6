// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tyndall/math/constants.h"

namespace tyndall {

/// Linear RGB: radiance, throughput, or coefficients per channel. Primaries of Rec. 709.
struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}
  constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}

  constexpr float operator[](int i) const {
    assert(0 <= i && i < 3);
    return i == 0 ? r : i == 1 ? g : b;
  }
  constexpr float& operator[](int i) {
    assert(0 <= i && i < 3);
    return i == 0 ? r : i == 1 ? g : b;
  }
  constexpr Rgb& operator+=(Rgb o) { return r += o.r, g += o.g, b += o.b, *this; }
  constexpr Rgb& operator-=(Rgb o) { return r -= o.r, g -= o.g, b -= o.b, *this; }
  constexpr Rgb& operator*=(Rgb o) { return r *= o.r, g *= o.g, b *= o.b, *this; }
  constexpr Rgb& operator*=(float s) { return r *= s, g *= s, b *= s, *this; }
  constexpr Rgb& operator/=(float s) { return *this *= 1 / s; }

  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

constexpr Rgb operator+(Rgb a, Rgb b) { return a += b; }
constexpr Rgb operator-(Rgb a, Rgb b) { return a -= b; }
constexpr Rgb operator*(Rgb a, Rgb b) { return a *= b; }
constexpr Rgb operator*(Rgb a, float s) { return a *= s; }
constexpr Rgb operator*(float s, Rgb a) { return a *= s; }
constexpr Rgb operator/(Rgb a, float s) { return a /= s; }

/// Per channel a / b, zero where b is zero.
constexpr Rgb safe_divide(Rgb a, Rgb b) {
  return {b.r != 0 ? a.r / b.r : 0, b.g != 0 ? a.g / b.g : 0, b.b != 0 ? a.b / b.b : 0};
}

inline Rgb exp(Rgb a) { return {std::exp(a.r), std::exp(a.g), std::exp(a.b)}; }
constexpr float average(Rgb a) { return (a.r + a.g + a.b) * (1.0f / 3); }
constexpr float max_component(Rgb a) { return std::max({a.r, a.g, a.b}); }
constexpr float min_component(Rgb a) { return std::min({a.r, a.g, a.b}); }
constexpr float luminance(Rgb a) { return 0.2126f * a.r + 0.7152f * a.g + 0.0722f * a.b; }
constexpr bool is_black(Rgb a) { return a.r == 0 && a.g == 0 && a.b == 0; }
constexpr bool is_grey(Rgb a) { return a.r == a.g && a.g == a.b; }
inline bool is_finite(Rgb a) {
  return std::isfinite(a.r) && std::isfinite(a.g) && std::isfinite(a.b);
}
constexpr Rgb clamp_negative(Rgb a) {
  return {std::max(a.r, 0.0f), std::max(a.g, 0.0f), std::max(a.b, 0.0f)};
}

}  // namespace tyndall
