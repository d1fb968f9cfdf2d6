// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tyndall/geometry/intersector.h"
#include "tyndall/geometry/shape.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

Vec3 random_in_cube(RandomStream& random) {
  const float x = random.next_1d(), y = random.next_1d(), z = random.next_1d();
  return Vec3{x, y, z} * 2 - Vec3{1, 1, 1};
}

/// Rays in all directions from all over the cube [-1, 1]^3.
std::vector<Ray> incoherent_rays() {
  RandomStream random(1);
  std::vector<Ray> rays;
  while (rays.size() < 4096) {
    const Vec3 d = random_in_cube(random);
    if (length_squared(d) > 0.01f) rays.push_back({random_in_cube(random), normalize(d)});
  }
  return rays;
}

/// A square of n x n squares of two triangles, bent a little.
TriangleMesh grid_mesh(int n) {
  std::vector<Vec3> positions;
  std::vector<Vec3i> triangles;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const Vec2 p{2.0f * static_cast<float>(x) / static_cast<float>(n) - 1,
                   2.0f * static_cast<float>(y) / static_cast<float>(n) - 1};
      positions.push_back({p.x, p.y, 0.3f * std::sin(5 * p.x) * std::cos(4 * p.y)});
      const int i = y * (n + 1) + x;
      if (x == n || y == n) continue;
      triangles.push_back({i, i + 1, i + n + 2});
      triangles.push_back({i, i + n + 2, i + n + 1});
    }
  return {positions, triangles, {}, {}, false};
}

/// The twelve triangles of the cube [-1, 1]^3.
TriangleMesh box_mesh() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  std::vector<Vec3i> triangles{{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                               {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                               {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return {corners, triangles, {}, {}, false};
}

Shape shape(int64_t kind) {
  switch (kind) {
    case 0:
      return box_mesh();
    case 1:
      return grid_mesh(700);
    case 2:
      return Sphere{Transform(), 0.9f, -0.9f, 0.9f, 2 * pi, false};
    case 3:
      return Disk{Transform(), 0, 0.9f, 0, 2 * pi, false};
    default:
      return BilinearMesh({{-1, -1, -0.5f}, {1, -1, 0.5f}, {-1, 1, 0.5f}, {1, 1, -0.5f}},
                          {{0, 1, 2, 3}}, {}, {}, false);
  }
}

const char* const names[] = {"box", "triangles_1M", "sphere", "disk", "patch"};

/// Arguments: the shape, and whether it is an instance.
Intersector make_scene(const Shape& shape, bool is_instanced) {
  std::vector<Intersector::Group> groups{{}};
  std::vector<Intersector::Instance> instances;
  if (is_instanced) {
    groups.push_back({{&shape, false}});
    instances.push_back({1, Transform::rotate(0.1f, {1, 2, 3})});
  } else {
    groups[0].push_back({&shape, false});
  }
  return Intersector(groups, instances);
}

void intersect(benchmark::State& state) {
  const Shape s = shape(state.range(0));
  const Intersector scene = make_scene(s, state.range(1) != 0);
  const std::vector<Ray> rays = incoherent_rays();
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(scene.intersect(rays[i], infinity, RayMask::all));
    i = (i + 1) % rays.size();
  }
  state.SetLabel(names[state.range(0)]);
}

void is_occluded(benchmark::State& state) {
  const Shape s = shape(state.range(0));
  const Intersector scene = make_scene(s, state.range(1) != 0);
  const std::vector<Ray> rays = incoherent_rays();
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(scene.is_occluded(rays[i], infinity, RayMask::all));
    i = (i + 1) % rays.size();
  }
  state.SetLabel(names[state.range(0)]);
}

/// As connections have them: between two points of the air, no two rays alike.
void shadow_ray(benchmark::State& state) {
  const Shape s = shape(state.range(0));
  const Intersector scene = make_scene(s, false);
  RandomStream random(3);
  std::vector<std::pair<Ray, float>> rays(4096);
  for (auto& [ray, t_max] : rays) {
    const Vec3 from = random_in_cube(random), to = random_in_cube(random);
    t_max = length(to - from);
    ray = {from, (to - from) / t_max};
  }
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        scene.is_occluded(rays[i].first, rays[i].second, RayMask::all));
    i = (i + 1) % rays.size();
  }
  state.SetLabel(names[state.range(0)]);
}

void sample_and_pdf(benchmark::State& state) {
  const Shape s = shape(state.range(0));
  RandomStream random(2);
  for (auto _ : state) {
    const Vec3 from = random_in_cube(random) + Vec3{0, 0, 3};
    const auto sample = sample_direction(s, from, random.next_2d());
    if (sample) benchmark::DoNotOptimize(direction_pdf(s, from, sample->point));
  }
  state.SetLabel(names[state.range(0)]);
}

BENCHMARK(intersect)->ArgsProduct({{0, 1, 2, 3, 4}, {0, 1}});
BENCHMARK(is_occluded)->ArgsProduct({{0, 1, 2, 3, 4}, {0, 1}});
BENCHMARK(shadow_ray)->DenseRange(0, 1);
BENCHMARK(sample_and_pdf)->DenseRange(0, 4);

}  // namespace
}  // namespace tyndall

BENCHMARK_MAIN();
