// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/flip_color.h"

#include <cmath>
#include <cstddef>

namespace tyndall::flip {
namespace {

// sRGB's primaries and white, IEC 61966-2-1, to the digits of exact fractions.
constexpr double xyz_from_rgb[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double rgb_from_xyz[3][3] = {
    {3.241003232976358, -1.537398969488785, -0.498615881996363},
    {-0.969224252202516, 1.875929983695176, 0.041554226340085},
    {0.055639419851975, -0.204011206123910, 1.057148977187533}};
const Triple white = {xyz_from_rgb[0][0] + xyz_from_rgb[0][1] + xyz_from_rgb[0][2],
                      xyz_from_rgb[1][0] + xyz_from_rgb[1][1] + xyz_from_rgb[1][2],
                      xyz_from_rgb[2][0] + xyz_from_rgb[2][1] + xyz_from_rgb[2][2]};

Triple multiply(const double (&m)[3][3], Triple v) {
  Triple result;
  for (size_t i = 0; i < 3; ++i)
    result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

/// Of white 1: XYZ per channel over the white's.
Triple relative_xyz(Triple rgb) {
  Triple xyz = multiply(xyz_from_rgb, rgb);
  for (size_t i = 0; i < 3; ++i) xyz[i] /= white[i];
  return xyz;
}

}  // namespace

Triple opponent_from_rgb(Triple rgb) {
  const Triple t = relative_xyz(rgb);
  return {116 * t[1] - 16, 500 * (t[0] - t[1]), 200 * (t[1] - t[2])};
}

Triple rgb_from_opponent(Triple o) {
  const double y = (o[0] + 16) / 116;
  return multiply(rgb_from_xyz,
                  {white[0] * (y + o[1] / 500), white[1] * y, white[2] * (y - o[2] / 200)});
}

Triple hunt_lab_from_rgb(Triple rgb) {
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29;
    // Single precision takes half the time and is exact to 1e-5 of a lightness of 100.
    return t > delta * delta * delta ? double{std::cbrt(static_cast<float>(t))}
                                     : t / (3 * delta * delta) + 4.0 / 29;
  };
  const Triple t = relative_xyz(rgb);
  const double lightness = 116 * f(t[1]) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(t[0]) - f(t[1])),
          0.01 * lightness * 200 * (f(t[1]) - f(t[2]))};
}

double hyab(Triple a, Triple b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

}  // namespace tyndall::flip
