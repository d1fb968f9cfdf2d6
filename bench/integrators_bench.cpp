// SPDX-License-Identifier: Apache-2.0
//
// Whole paths: samples per second of each integrator in a room of smoke or fog with one
// lamp, through few and through many triangles. "items_per_second" are path samples; those
// of BM_BareWalk are what rays and media alone allow.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "bare_walk.h"
#include "smoke.h"
#include "tyndall/integrators/integrator.h"
#include "tyndall/sampling/warps.h"
#include "tyndall/scene/scene.h"

namespace tyndall {
namespace {

constexpr int max_depth = 8, many_squares = 289;
constexpr float albedo = 0.9f, reflectance = 0.5f;
constexpr Vec3 lamp{0.3f, 0.8f, -0.2f};

// The cube [-1, 1]^3 seen from inside; each side has n x n squares of two triangles, bent a
// little if there are many.
TriangleMesh room(int n) {
  std::vector<Vec3> positions;
  std::vector<Vec3i> triangles;
  for (int side = 0; side < 6; ++side) {
    const auto first = static_cast<int>(positions.size());
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const float a = 2 * static_cast<float>(x) / static_cast<float>(n) - 1;
        const float b = 2 * static_cast<float>(y) / static_cast<float>(n) - 1;
        const bool is_rim = x == 0 || y == 0 || x == n || y == n;
        const float bump = is_rim ? 0 : 0.02f * std::sin(30 * a) * std::sin(25 * b);
        Vec3 p;
        p[side % 3] = (side < 3 ? 1.0f : -1.0f) + bump;
        p[(side + 1) % 3] = a;
        p[(side + 2) % 3] = b;
        positions.push_back(p);
        if (x == n || y == n) continue;
        const int i = first + y * (n + 1) + x;
        triangles.push_back({i, i + 1, i + n + 2});
        triangles.push_back({i, i + n + 2, i + n + 1});
      }
  }
  return {positions, triangles, {}, {}, false};
}

// All fill the room. The optical depth across smoke varies a lot.
Medium medium(int64_t kind) {
  const auto properties = [](float sigma_t) {
    return MediumProperties{Rgb((1 - albedo) * sigma_t), Rgb(albedo * sigma_t), Rgb(0)};
  };
  if (kind == 0) return Medium(HomogeneousMedium(properties(1), IsotropicPhase{}));
  static const DensityGrid smoke = make_smoke(128);
  return Medium(GridMedium(smoke, {{-1, -1, -1}, {1, 1, 1}}, Transform(),
                           properties(kind == 1 ? 4 : 20), IsotropicPhase{}));
}

std::unique_ptr<Scene> make_scene(int64_t medium_kind, int squares) {
  SceneDescription d;
  d.media.push_back(medium(medium_kind));
  d.camera_medium = 0;
  d.surfaces.push_back({.shape = room(squares),
                        .material = DiffuseBsdf{Rgb(reflectance)},
                        .media = {},
                        .emission = std::nullopt,
                        .name = "room"});
  d.lights.emplace_back(PointLight{lamp, Rgb(1)});
  return std::make_unique<Scene>(std::move(d));
}

// Camera rays from all over the room, in all directions.
Ray random_ray(Sampler& sampler) {
  const Vec2 xy = sampler.next_2d();
  const Vec3 o{xy.x, xy.y, sampler.next_1d()};
  return {o * 1.8f - Vec3{0.9f, 0.9f, 0.9f}, sample_uniform_sphere(sampler.next_2d())};
}

void BM_Paths(benchmark::State& state, const std::string& name) {
  const std::unique_ptr<Scene> scene =
      make_scene(state.range(0), state.range(1) ? many_squares : 1);
  RenderSettings settings;
  settings.integrator = name;
  settings.max_depth = max_depth;
  settings.resolution = settings.crop_max = {1, 1};
  const std::unique_ptr<Integrator> integrator = make_integrator(*scene, settings);
  uint32_t i = 0, allowed = 0;
  for (auto _ : state) {
    if (i >= allowed) allowed = integrator->prepare(i, {});
    Sampler sampler(SamplerKind::sobol, 1, {0, 0}, i++);
    const Ray ray = random_ray(sampler);
    benchmark::DoNotOptimize(integrator->Li(ray, sampler));
  }
  state.SetItemsProcessed(state.iterations());
}

void BM_BareWalk(benchmark::State& state) {
  const TriangleMesh mesh = room(state.range(1) ? many_squares : 1);
  const Medium inside = medium(state.range(0));
  const BareWalk kernel(mesh, inside, lamp);
  RandomStream rng(1);
  uint32_t i = 0;
  for (auto _ : state) {
    Sampler sampler(SamplerKind::sobol, 1, {0, 0}, i++);
    benchmark::DoNotOptimize(
        kernel.walk(random_ray(sampler), max_depth, albedo, reflectance, rng));
  }
  state.SetItemsProcessed(state.iterations());
}

void every_scene(benchmark::internal::Benchmark* benchmark) {
  // 0: fog, 1: thin smoke, 2: dense smoke; 0: twelve triangles, 1: a million.
  benchmark->ArgNames({"medium", "million"})->ArgsProduct({{0, 1, 2}, {0, 1}});
}
BENCHMARK(BM_BareWalk)->Apply(every_scene);
BENCHMARK_CAPTURE(BM_Paths, volpath, "volpath")->Apply(every_scene);
BENCHMARK_CAPTURE(BM_Paths, equiangular, "equiangular")->Apply(every_scene);
BENCHMARK_CAPTURE(BM_Paths, jis, "jis")->Apply(every_scene);
BENCHMARK_CAPTURE(BM_Paths, learned, "learned")->Apply(every_scene);

}  // namespace
}  // namespace tyndall

BENCHMARK_MAIN();
