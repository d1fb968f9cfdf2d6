// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/cloud_density.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tyndall/math/parallel_for.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

// Noise and its derivatives.
struct Noise {
  float value;
  Vec3 gradient;
};

// The gradient at a lattice point: one of the twelve edges of a cube, as in [Perlin02].
// One hash and a table: a cloud looks here a thousand million times.
Vec3 lattice_gradient(int x, int y, int z) {
  static constexpr Vec3 edges[12] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0},
                                     {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                     {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}};
  const uint64_t key = static_cast<uint64_t>(x) * 0x9e3779b97f4a7c15u ^
                       static_cast<uint64_t>(y) * 0xc2b2ae3d27d4eb4fu ^
                       static_cast<uint64_t>(z) * 0x165667b19e3779f9u;
  return edges[((mix_bits(key) >> 32) * 12) >> 32];
}

// Without a call of the library, unlike std::floor.
int floor_to_int(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (x < static_cast<float>(truncated) ? 1 : 0);
}

// Gradient noise with quintic fades [Perlin02].
Noise noise(Vec3 p) {
  const Vec3i cell{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
  const Vec3 f = p - Vec3{static_cast<float>(cell.x), static_cast<float>(cell.y),
                          static_cast<float>(cell.z)};
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const auto slope = [](float t) { return 30 * t * t * (t * (t - 2) + 1); };
  const Vec3 w{fade(f.x), fade(f.y), fade(f.z)}, dw{slope(f.x), slope(f.y), slope(f.z)};
  Noise sum{};
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2 & 1;
    const Vec3 g = lattice_gradient(cell.x + dx, cell.y + dy, cell.z + dz);
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
  // Far from the origin floats cannot tell the points of the noise apart.
  constexpr float far = 1e6f;
  Vec3 q = min(max(p * parameters.frequency, Vec3{-far, -far, -far}), Vec3{far, far, far});
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
      std::clamp(std::max(1 - p.y, 0.0f) * 4.5f * parameters.density * sum, 0.0f, 1.0f);
  return std::clamp(thinning + 2 * std::max(0.0f, 0.5f - p.y), 0.0f, 1.0f);
}

PlacedGrid make_cloud(const CloudParameters& parameters, const Bounds3& bounds) {
  constexpr int finest = 192;
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
  parallel_for(rows, [&](size_t r) {
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
