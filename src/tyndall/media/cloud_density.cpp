// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/cloud_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tyndall/math/parallel_for.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

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

// A number for each corner of a cell; x runs fastest.
using Corners = std::array<float, 8>;
Corners along_x(float low, float high) {
  return {low, high, low, high, low, high, low, high};
}
Corners along_y(float low, float high) {
  return {low, low, high, high, low, low, high, high};
}
Corners along_z(float low, float high) {
  return {low, low, low, low, high, high, high, high};
}

// Gradient noise with quintic fades [Perlin02]. Keeps the lattice's gradients about the
// last point, for the next point is often in the same cell.
class LatticeNoise {
 public:
  float value(Vec3 p) {
    const Place at = enter_cell(p);
    Corners parts;
    for (size_t i = 0; i < 8; ++i)
      parts[i] = at.weight_x[i] * at.weight_y[i] * at.weight_z[i] * slope_at(i, at);
    float sum = 0;
    for (const float part : parts) sum += part;
    return sum;
  }

  Vec3 gradient(Vec3 p) {
    const Place at = enter_cell(p);
    const float x = fade_slope(at.x[0]), y = fade_slope(at.y[0]), z = fade_slope(at.z[0]);
    const Corners dx = along_x(-x, x), dy = along_y(-y, y), dz = along_z(-z, z);
    std::array<Corners, 3> of_slopes, of_weights;
    for (size_t i = 0; i < 8; ++i) {
      const float v = slope_at(i, at);
      const float wx = at.weight_x[i], wy = at.weight_y[i], wz = at.weight_z[i];
      of_slopes[0][i] = x_[i] * (wx * wy * wz);
      of_slopes[1][i] = y_[i] * (wx * wy * wz);
      of_slopes[2][i] = z_[i] * (wx * wy * wz);
      of_weights[0][i] = dx[i] * wy * wz * v;
      of_weights[1][i] = wx * dy[i] * wz * v;
      of_weights[2][i] = wx * wy * dz[i] * v;
    }
    Vec3 sum{};
    for (size_t i = 0; i < 8; ++i) {
      sum += Vec3{of_slopes[0][i], of_slopes[1][i], of_slopes[2][i]};
      sum += Vec3{of_weights[0][i], of_weights[1][i], of_weights[2][i]};
    }
    return sum;
  }

 private:
  // A point as seen from the corners of its cell, and their weights.
  struct Place {
    Corners x, y, z, weight_x, weight_y, weight_z;
  };

  static float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
  static float fade_slope(float t) { return 30 * t * t * (t * (t - 2) + 1); }

  // What the slope at a corner makes of the way to the point.
  float slope_at(size_t i, const Place& at) const {
    return x_[i] * at.x[i] + y_[i] * at.y[i] + z_[i] * at.z[i];
  }

  Place enter_cell(Vec3 p) {
    const Vec3i cell{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
    if (cell != cell_) look_up(cell);
    const Vec3 f = p - Vec3{static_cast<float>(cell.x), static_cast<float>(cell.y),
                            static_cast<float>(cell.z)};
    const Vec3 w{fade(f.x), fade(f.y), fade(f.z)};
    return {along_x(f.x, f.x - 1), along_y(f.y, f.y - 1), along_z(f.z, f.z - 1),
            along_x(1 - w.x, w.x), along_y(1 - w.y, w.y), along_z(1 - w.z, w.z)};
  }

  void look_up(Vec3i cell) {
    cell_ = cell;
    for (int i = 0; i < 8; ++i) {
      const Vec3 g =
          lattice_gradient(cell.x + (i & 1), cell.y + (i >> 1 & 1), cell.z + (i >> 2));
      x_[static_cast<size_t>(i)] = g.x;
      y_[static_cast<size_t>(i)] = g.y;
      z_[static_cast<size_t>(i)] = g.z;
    }
  }

  Vec3i cell_{INT32_MIN, 0, 0};  // none: points are less far
  Corners x_{}, y_{}, z_{};
};

// Noise for each of the scales of a cloud.
struct CloudNoise {
  std::array<LatticeNoise, 2> wisps;
  std::array<LatticeNoise, 5> octaves;
};

float density_at(const CloudParameters& parameters, Vec3 p, CloudNoise& noise) {
  // Far from the origin floats cannot tell the points of the noise apart.
  constexpr float far = 1e6f;
  Vec3 q = min(max(p * parameters.frequency, Vec3{-far, -far, -far}), Vec3{far, far, far});
  float strength = 0.05f * parameters.wispiness, pitch = 10;
  for (LatticeNoise& wisp : noise.wisps) {
    if (!(parameters.wispiness > 0)) break;
    q += strength * wisp.gradient(pitch * q);
    strength *= 0.5f;
    pitch *= 1.99f;
  }
  float sum = 0, amplitude = 0.5f, scale = 1;
  for (LatticeNoise& octave : noise.octaves) {
    sum += amplitude * octave.value(scale * q);
    amplitude *= 0.5f;
    scale *= 1.99f;
  }
  const float thinning =
      std::clamp(std::max(1 - p.y, 0.0f) * 4.5f * parameters.density * sum, 0.0f, 1.0f);
  return std::clamp(thinning + 2 * std::max(0.0f, 0.5f - p.y), 0.0f, 1.0f);
}

}  // namespace

float cloud_density(const CloudParameters& parameters, Vec3 p) {
  CloudNoise noise;
  return density_at(parameters, p, noise);
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
    CloudNoise noise;
    for (int x = 0; x < n.x; ++x) {
      const Vec3 p =
          bounds.min + size * Vec3{center(x, n.x), center(y, n.y), center(z, n.z)};
      grid.values[r * row + static_cast<size_t>(x)] = density_at(parameters, p, noise);
    }
  });
  return place_in_box(grid, bounds);
}

}  // namespace tyndall
