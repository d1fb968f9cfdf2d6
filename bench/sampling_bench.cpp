// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <vector>

#include "tyndall/lights/light.h"
#include "tyndall/materials/bsdf.h"
#include "tyndall/sampling/sampler.h"
#include "tyndall/sampling/tabulated.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

constexpr auto independent = static_cast<int64_t>(SamplerKind::independent);
constexpr auto sobol = static_cast<int64_t>(SamplerKind::sobol);

// One sample of a path: a sampler and `range(1)` pairs of numbers.
void sampler_pairs(benchmark::State& state) {
  const auto kind = static_cast<SamplerKind>(state.range(0));
  const int64_t pairs = state.range(1);
  uint32_t index = 0;
  for (auto _ : state) {
    Sampler sampler(kind, 1, {3, 4}, index++);
    for (int64_t d = 0; d < pairs; ++d) benchmark::DoNotOptimize(sampler.next_2d());
  }
  state.SetItemsProcessed(state.iterations() * pairs);
}
BENCHMARK(sampler_pairs)->Args({independent, 16})->Args({sobol, 16});

void random_stream(benchmark::State& state) {
  RandomStream random(1);
  for (auto _ : state) benchmark::DoNotOptimize(random.next_1d());
}
BENCHMARK(random_stream);

template <Vec3 (*sample)(Vec2)>
void warp(benchmark::State& state) {
  RandomStream random(1);
  for (auto _ : state) benchmark::DoNotOptimize(sample(random.next_2d()));
}
BENCHMARK(warp<sample_cosine_hemisphere>);
BENCHMARK(warp<sample_uniform_sphere>);

void exponential(benchmark::State& state) {
  RandomStream random(1);
  for (auto _ : state)
    benchmark::DoNotOptimize(sample_exponential(random.next_1d(), 2.5f, 3.0f));
}
BENCHMARK(exponential);

// Directions of an environment image of `range(0)` pixels a side.
void environment(benchmark::State& state) {
  const auto side = static_cast<int>(state.range(0));
  RandomStream random(1);
  std::vector<Rgb> pixels(static_cast<size_t>(side) * static_cast<size_t>(side));
  for (Rgb& p : pixels) p = Rgb(random.next_1d());
  const Light light(ImageEnvironment(Transform(), side, pixels, 1));
  for (auto _ : state) benchmark::DoNotOptimize(light.sample({}, random.next_2d()));
}
BENCHMARK(environment)->Arg(64)->Arg(1024);

void glossy_glass(benchmark::State& state) {
  const Material material = DielectricBsdf{1.5f, 0.3f, 0.3f};
  const Bsdf bsdf(material, {0, 0, 1}, {0, 0, 1});
  RandomStream random(1);
  for (auto _ : state) {
    const Vec3 wo = sample_uniform_sphere(random.next_2d());
    const float u_lobe = random.next_1d();
    benchmark::DoNotOptimize(bsdf.sample(wo, u_lobe, random.next_2d()));
  }
}
BENCHMARK(glossy_glass);

}  // namespace
}  // namespace tyndall

BENCHMARK_MAIN();
