// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "tyndall/guiding/gaussian_mixture.h"
#include "tyndall/guiding/light_square.h"
#include "tyndall/guiding/online_em.h"
#include "tyndall/guiding/optical_depth_map.h"
#include "tyndall/guiding/record_cache.h"
#include "tyndall/guiding/visibility_map.h"
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

void BM_LightSquareDirection(benchmark::State& state) {
  const LightSquare square(Frame::from_z({0, 0.6f, 0.8f}), SquareMeasure::joint_sampling);
  RandomStream random(1);
  std::vector<Vec2> points(point_count);
  for (Vec2& p : points) p = random.next_2d();
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(square.direction(points[i++ % point_count]));
  }
}
BENCHMARK(BM_LightSquareDirection);

void BM_LightSquarePoint(benchmark::State& state) {
  const LightSquare square(Frame::from_z({0, 0.6f, 0.8f}), SquareMeasure::joint_sampling);
  RandomStream random(1);
  std::vector<Vec3> directions(point_count);
  for (Vec3& w : directions) w = square.direction(random.next_2d()).w;
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(square.point(directions[i++ % point_count]));
  }
}
BENCHMARK(BM_LightSquarePoint);

/// One E step of an eight-component mixture; items are samples.
void BM_EmSweep(benchmark::State& state) {
  RandomStream random(1);
  const GaussianMixture mixture = random_mixture(random);
  std::vector<WeightedPoint> points(point_count);
  for (WeightedPoint& p : points) p = {random.next_2d(), random.next_1d()};
  for (auto _ : state) {
    MixtureStatistics statistics;
    statistics.add(mixture, points);
    benchmark::DoNotOptimize(statistics);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(point_count));
}
BENCHMARK(BM_EmSweep);

std::vector<Ray> random_rays() {
  RandomStream random(2);
  std::vector<Ray> rays(1024);
  for (Ray& ray : rays) {
    const Vec2 u = random.next_2d();
    ray.o = Vec3{random.next_1d(), random.next_1d(), random.next_1d()} * 2 - Vec3{1, 1, 1};
    ray.d = spherical_direction(2 * u.x - 1, 6.28f * u.y);
  }
  return rays;
}

/// 64 points along a ray, by resolution of the map and its kind.
void BM_VisibilityBatch(benchmark::State& state) {
  const LightView views[] = {LightView::around({0, 0, 0}),
                             LightView::cone({0, 0, 0}, {0, 0, 1}, 0.7f),
                             LightView::parallel({0, 0, 1}, {{-2, -2, -2}, {2, 2, 2}})};
  VisibilityMapSettings settings;
  settings.resolution = static_cast<int>(state.range(1));
  VisibilityMap map(views[state.range(0)], settings);
  map.trace_rows(0, map.rows(),
                 [](const Ray& r, Vec2) { return r.d.x > 0.3f ? 0.7f : 2.0f; });
  map.finish();
  const std::vector<Ray> rays = random_rays();
  std::vector<float> t(64), out(64);
  for (size_t i = 0; i < t.size(); ++i) t[i] = 0.04f * static_cast<float>(i);
  size_t i = 0;
  for (auto _ : state) {
    map.visibility(rays[i++ % 1024], t, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 64);
}
BENCHMARK(BM_VisibilityBatch)
    ->ArgNames({"view", "resolution"})
    ->ArgsProduct({{0, 1, 2}, {128, 512}})
    ->Args({0, 2048});

void BM_OpticalDepthBatch(benchmark::State& state) {
  OpticalDepthMap map(LightView::around({0, 0, 0}), 3);
  map.trace_rows(0, map.rows(),
                 [](const Ray&, std::span<const float> t, std::span<float> out) {
                   std::ranges::copy(t, out.begin());
                 });
  const std::vector<Ray> rays = random_rays();
  std::vector<float> t(64), out(64);
  for (size_t i = 0; i < t.size(); ++i) t[i] = 0.04f * static_cast<float>(i);
  size_t i = 0;
  for (auto _ : state) {
    map.transmittance(rays[i++ % 1024], t, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 64);
}
BENCHMARK(BM_OpticalDepthBatch);

/// A cache of about range(0) records in the unit cube.
RecordCache large_cache(int64_t records) {
  RecordCacheSettings settings;
  settings.split_samples = 2;
  settings.relative_change = 1e-6;
  RecordCache cache({LightCluster{}}, settings);
  RandomStream random(1);
  TrainingBuffer buffer(static_cast<size_t>(2 * records));
  for (size_t i = 0; i < buffer.size(); ++i) {
    TrainingSample& s = buffer[i];
    s.key = i;
    s.p = {random.next_1d(), random.next_1d(), random.next_1d()};
    s.wi = s.light_direction = {0, 0, 1};
    s.weight = s.pdf = s.light_distance = 1;
  }
  cache.update({&buffer, 1});
  return cache;
}

void BM_FindRecord(benchmark::State& state) {
  const RecordCache cache = large_cache(state.range(0));
  const auto field = cache.field();
  RandomStream random(2);
  std::vector<Vec3> points(order_size);
  for (Vec3& p : points) p = {random.next_1d(), random.next_1d(), random.next_1d()};
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(field->find(points[i++ % order_size]));
  state.counters["records"] = static_cast<double>(field->records().size());
}
BENCHMARK(BM_FindRecord)->Arg(1000)->Arg(100'000);

/// All that a direction costs: record, guide, square, sample, and its density.
void BM_GuidedDirection(benchmark::State& state) {
  const RecordCache cache = large_cache(state.range(0));
  const auto field = cache.field();
  RandomStream random(2);
  std::vector<Vec3> points(order_size);
  for (Vec3& p : points) p = {random.next_1d(), random.next_1d(), random.next_1d()};
  size_t i = 0;
  for (auto _ : state) {
    const Vec3 p = points[i++ % order_size];
    const GuidingRecord* record = field->find(p);
    if (!record) continue;
    const DirectionGuide* guide = field->guide(*record, 0);
    if (!guide) continue;
    const LightSquare square = guide->square(normalize(Vec3{0, 0, 9} - p));
    benchmark::DoNotOptimize(guide->sample(square, {p.x, p.y}));
  }
}
BENCHMARK(BM_GuidedDirection)->Arg(100)->Arg(100'000);

/// Training: items are samples.
void BM_Update(benchmark::State& state) {
  RandomStream random(1);
  TrainingBuffer buffer(100'000);
  for (size_t i = 0; i < buffer.size(); ++i) {
    TrainingSample& s = buffer[i];
    s.key = i;
    s.p = {random.next_1d(), random.next_1d(), random.next_1d()};
    const float cos_theta = random.next_1d();
    s.wi = spherical_direction(cos_theta, 6.28f * random.next_1d());
    s.light_direction = {0, 0, 1};
    s.weight = s.pdf = s.light_distance = 1;
  }
  RecordCache cache({LightCluster{}});
  for (auto _ : state) cache.update({&buffer, 1});
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(buffer.size()));
}
BENCHMARK(BM_Update);

}  // namespace
}  // namespace tyndall

BENCHMARK_MAIN();
