// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstdint>
#include <limits>

#include "tyndall/geometry/intersector.h"

namespace tyndall {
namespace {

// The float that is `steps` floats above x; negative steps go down.
float float_neighbor(float x, int32_t steps) {
  // Sign and magnitude become a number that is in the order of the floats, and back.
  const auto flip = [](int32_t i) {
    return i < 0 ? std::numeric_limits<int32_t>::min() - i : i;
  };
  return std::bit_cast<float>(flip(flip(std::bit_cast<int32_t>(x)) + steps));
}

// By how many floats offset_origin() moves each coordinate.
constexpr int32_t origin_steps = 4;

}  // namespace

Vec3 offset_origin(Vec3 p, Vec3 ng, Vec3 d) {
  // Rounding has moved p along the true normal n by at most the sum over its coordinates of
  // |n_i| half a unit in the last place; each step below moves it by the sum of |n_i| times
  // a whole one. The spare steps cover what callers compute with p in float.
  constexpr int32_t steps = origin_steps;
  const Vec3 side = dot(ng, d) < 0 ? -ng : ng;
  Vec3 moved = p;
  for (int i = 0; i < 3; ++i) {
    if (side[i] > 0) moved[i] = float_neighbor(p[i], steps);
    if (side[i] < 0) moved[i] = float_neighbor(p[i], -steps);
  }
  return moved;
}

float rounded_end(Vec3 p, Vec3 end, Vec3 ng) {
  constexpr float unit = 0x1p-23f;  // the largest step between floats, relative
  const Vec3 d = end - p, n = abs(ng);
  // Along the normal: the ray's origin, its end, and its direction.
  const float error =
      unit * (dot(n, abs(p)) * origin_steps + dot(n, abs(end)) + 2 * length(d));
  const float distance = length(d), slope = magnitude(dot(ng, d));
  return slope > error ? distance * (error / slope) : distance;
}

}  // namespace tyndall
