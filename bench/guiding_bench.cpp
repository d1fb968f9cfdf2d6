// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <vector>

#include "tyndall/guiding/gaussian_mixture.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr size_t point_count = 4096, order_size = 1 << 16;

GaussianMixture random_mixture(RandomStream& random) {
  std::vector<GaussianComponent> components(GaussianMixture::capacity);
  for (GaussianComponent& c : components)
    c = {.weight = 0.1f + random.next_1d(),
         .mean = random.next_2d(),
         .covariance = {0.001f + 0.01f * random.next_1d(), 0,
                        0.001f + 0.01f * random.next_1d()}};
  return GaussianMixture(components);
}

/// Mixtures and points to visit in random order; range(0) mixtures of 256 bytes.
struct MixtureFixture {
  explicit MixtureFixture(const benchmark::State& state) {
    RandomStream random(1);
    for (int64_t i = 0; i < state.range(0); ++i) mixtures.push_back(random_mixture(random));
    for (Vec2& p : points) p = random.next_2d();
    for (size_t& i : order) i = random.next_bits() % mixtures.size();
  }

  std::vector<GaussianMixture> mixtures;
  std::vector<Vec2> points = std::vector<Vec2>(point_count);
  std::vector<size_t> order = std::vector<size_t>(order_size);
};

void BM_MixturePdf(benchmark::State& state) {
  const MixtureFixture f(state);
  size_t i = 0;
  for (auto _ : state) {
    const GaussianMixture& mixture = f.mixtures[f.order[i % order_size]];
    benchmark::DoNotOptimize(mixture.pdf(f.points[i++ % point_count]));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_MixturePdf)->ArgName("mixtures")->Arg(16)->Arg(1 << 15);

void BM_MixtureSample(benchmark::State& state) {
  const MixtureFixture f(state);
  size_t i = 0;
  for (auto _ : state) {
    const GaussianMixture& mixture = f.mixtures[f.order[i % order_size]];
    benchmark::DoNotOptimize(mixture.sample(f.points[i++ % point_count]));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_MixtureSample)->ArgName("mixtures")->Arg(16)->Arg(1 << 15);

}  // namespace
}  // namespace tyndall

BENCHMARK_MAIN();
