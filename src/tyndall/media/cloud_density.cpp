// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/cloud_density.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// Noise and its derivatives.
struct Noise {
  float value;
  Vec3 gradient;
};

// The gradient at a lattice point: one of the twelve edges of a cube, as in [Perlin02].
Vec3 lattice_gradient(int x, int y, int z) {
  const uint64_t h = hash(x, y, z) >> 40;
  const float a = h & 1 ? 1.0f : -1.0f, b = h & 2 ? 1.0f : -1.0f;
  switch ((h >> 2) % 3) {
    case 0:
      return {a, b, 0};
    case 1:
      return {a, 0, b};
    default:
      return {0, a, b};
  }
}

// Gradient noise with quintic fades [Perlin02].
Noise noise(Vec3 p) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3 f = p - cell;
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const auto slope = [](float t) { return 30 * t * t * (t * (t - 2) + 1); };
  const Vec3 w{fade(f.x), fade(f.y), fade(f.z)}, dw{slope(f.x), slope(f.y), slope(f.z)};
  Noise sum{};
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2 & 1;
    const Vec3 g =
        lattice_gradient(static_cast<int>(cell.x) + dx, static_cast<int>(cell.y) + dy,
                         static_cast<int>(cell.z) + dz);
    const Vec3 to_corner{static_cast<float>(dx), static_cast<float>(dy),
                         static_cast<float>(dz)};
    const float v = dot(g, f - to_corner);
    const float wx = dx ? w.x : 1 - w.x, wy = dy ? w.y : 1 - w.y, wz = dz ? w.z : 1 - w.z;
    sum.value += wx * wy * wz * v;
    sum.gradient += g * (wx * wy * wz);
    sum.gradient += Vec3{(dx ? dw.x : -dw.x) * wy * wz, wx * (dy ? dw.y : -dw.y) * wz,
                         wx * wy * (dz ? dw.z : -dw.z)} *
                    v;
  }
  return sum;
}

}  // namespace

float cloud_density(const CloudParameters& parameters, Vec3 p) {
  Vec3 q = p * parameters.frequency;
  float strength = 0.05f * parameters.wispiness, pitch = 10;
  for (int i = 0; i < 2 && parameters.wispiness > 0; ++i) {
    q += strength * noise(pitch * q).gradient;
    strength *= 0.5f;
    pitch *= 1.99f;
  }
  float sum = 0, amplitude = 0.5f, scale = 1;
  for (int octave = 0; octave < 5; ++octave) {
    sum += amplitude * noise(scale * q).value;
    amplitude *= 0.5f;
    scale *= 1.99f;
  }
  const float thinning =
      std::clamp((1 - p.y) * 4.5f * parameters.density * sum, 0.0f, 1.0f);
  return std::clamp(thinning + 2 * std::max(0.0f, 0.5f - p.y), 0.0f, 1.0f);
}

PlacedGrid make_cloud(const CloudParameters& parameters, const Bounds3& bounds) {
  constexpr int finest = 256;
  // The fifth octave has 16 times the frequency; six samples per period.
  const float per_unit = 16 * 6 * std::max(parameters.frequency, 0.1f);
  const Vec3 size = bounds.diagonal();
  const auto count = [&](float extent) {
    const float samples = std::min(extent * per_unit, static_cast<float>(finest));
    return std::max(static_cast<int>(samples), 8);
  };
  DensityGrid grid{{count(size.x), count(size.y), count(size.z)}, {}};
  const Vec3i n = grid.resolution;
  const size_t row = static_cast<size_t>(n.x),
               rows = static_cast<size_t>(n.y) * static_cast<size_t>(n.z);
  grid.values.resize(row * rows);
  tbb::parallel_for(size_t{0}, rows, [&](size_t r) {
    const auto center = [](int i, int of) {
      return (static_cast<float>(i) + 0.5f) / static_cast<float>(of);
    };
    const int y = static_cast<int>(r) % n.y, z = static_cast<int>(r) / n.y;
    for (int x = 0; x < n.x; ++x) {
      const Vec3 p =
          bounds.min + size * Vec3{center(x, n.x), center(y, n.y), center(z, n.z)};
      grid.values[r * row + static_cast<size_t>(x)] = cloud_density(parameters, p);
    }
  });
  return place_in_box(grid, bounds);
}

}  // namespace tyndall
