// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "tyndall/media/brick_grid.h"
#include "tyndall/sampling/random.h"

namespace tyndall {

/// A random number in [-1, 1] for each lattice point, interpolated.
inline float value_noise(Vec3 p) {
  const auto at = [](float x, float y, float z) {
    const uint64_t h = hash(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
    return 2 * uniform_float(static_cast<uint32_t>(h >> 32)) - 1;
  };
  const Vec3 c{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  float sum = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 d{static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                 static_cast<float>(i >> 2 & 1)};
    const Vec3 w = abs(p - c - Vec3{1, 1, 1} + d);
    sum += w.x * w.y * w.z * at(c.x + d.x, c.y + d.y, c.z + d.z);
  }
  return sum;
}

/// A puff in the unit cube, about a third of it not empty, with detail down to its samples.
inline DensityGrid make_smoke(int n) {
  DensityGrid grid{{n, n, n}, {}};
  grid.values.reserve(static_cast<size_t>(n) * static_cast<size_t>(n) *
                      static_cast<size_t>(n));
  const float scale = 1 / static_cast<float>(n);
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vec3 p =
            Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} *
            scale;
        float noise = 0, amplitude = 0.5f;
        for (float frequency = 4; frequency < 100; frequency *= 2.1f, amplitude *= 0.6f)
          noise += amplitude * value_noise((p + Vec3{9, 9, 9}) * frequency);
        const float r = distance(p, {0.5f, 0.5f, 0.5f});
        grid.values.push_back(std::max(0.0f, 0.35f - r + 0.6f * noise));
      }
  return grid;
}

}  // namespace tyndall
