// SPDX-License-Identifier: Apache-2.0
//
// Grids: lookups, transmittance, walks. Every benchmark names its volume: "smoke" is made
// here, "vol" is read from ../shared if that is there. Optical depths are those of a mean
// ray.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "smoke.h"
#include "tyndall/math/statistics.h"
#include "tyndall/media/distance_proxy.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/media/medium.h"
#include "tyndall/media/tracking.h"
#include "tyndall/media/transmittance.h"

namespace tyndall {
namespace {

// A Mitsuba .vol file of one float channel; empty if it cannot be read.
DensityGrid read_vol(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  if (bytes.size() < 48) return {};
  int header[5];
  std::memcpy(header, bytes.data() + 4, sizeof header);
  DensityGrid grid{{header[1], header[2], header[3]}, {}};
  grid.values.resize((bytes.size() - 48) / sizeof(float));
  std::memcpy(grid.values.data(), bytes.data() + 48, grid.values.size() * sizeof(float));
  return grid;
}

const DensityGrid& volume(int which) {
  static const DensityGrid smoke = make_smoke(128), fine = make_smoke(276),
                           vol = read_vol(TYNDALL_SOURCE_DIR
                                          "/../shared/scenes/data/vol/lajolla_smoke.vol");
  return which == 0 ? smoke : which == 1 ? fine : vol;
}

// From points of positive density in random directions.
std::vector<Ray> rays_from_inside(const GridMedium& medium, size_t count) {
  RandomStream rng(5);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Vec3 o{rng.next_1d(), rng.next_1d(), rng.next_1d()};
    const float cos_theta = 2 * rng.next_1d() - 1;
    const Ray ray{o, spherical_direction(cos_theta, 2 * pi * rng.next_1d())};
    if (medium.at(ray.o).sigma_s.r > 0) rays.push_back(ray);
  }
  return rays;
}

struct Bed {
  GridMedium medium;
  std::vector<Ray> rays;
};

GridMedium scaled_medium(int which, float sigma) {
  return {volume(which),
          {{0, 0, 0}, {1, 1, 1}},
          Transform(),
          {Rgb(0), Rgb(sigma), {}},
          IsotropicPhase{}};
}

double mean_optical_depth(const GridMedium& medium, const std::vector<Ray>& rays) {
  double sum = 0;
  for (const Ray& ray : rays)
    sum += double{DistanceProxy(medium, ray, infinity).optical_depth(infinity).r};
  return sum / static_cast<double>(rays.size());
}

// The volume scaled so that a mean ray has the given optical depth.
Bed make_bed(const benchmark::State& state) {
  const int which = static_cast<int>(state.range(0));
  const GridMedium unit = scaled_medium(which, 1);
  const std::vector<Ray> rays = rays_from_inside(unit, 4096);
  const double scale =
      static_cast<double>(state.range(1)) / 100 / mean_optical_depth(unit, rays);
  return {scaled_medium(which, static_cast<float>(scale)), rays};
}

bool skip_if_missing(benchmark::State& state) {
  if (!volume(static_cast<int>(state.range(0))).values.empty()) return false;
  state.SkipWithError("no ../shared");
  return true;
}

void BM_Transmittance(benchmark::State& state) {
  if (skip_if_missing(state)) return;
  const Bed bed = make_bed(state);
  const Medium medium(bed.medium);
  const auto method = static_cast<TransmittanceMethod>(state.range(2));
  RandomStream rng(1);
  double variance = 0;
  for (size_t i = 0; i < 512; ++i) {
    RunningMoments moments;
    for (int k = 0; k < 256; ++k)
      moments.add(
          double{estimate_transmittance(medium, bed.rays[i], infinity, rng, method).r});
    variance += moments.variance() / 512;
  }
  size_t i = 0;
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state)
    benchmark::DoNotOptimize(estimate_transmittance(medium, bed.rays[i++ % bed.rays.size()],
                                                    infinity, rng, method));
  const double ns =
      std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start)
          .count();
  state.counters["variance"] = variance;
  state.counters["variance_x_ns"] = variance * ns / static_cast<double>(state.iterations());
}
BENCHMARK(BM_Transmittance)
    ->ArgNames({"volume", "depth_x100", "method"})
    ->ArgsProduct({{0, 1, 2}, {44, 220, 880}, {0, 1, 2}});

// One delta-tracked collision: where the next scattering happens, if at all.
void BM_DeltaTracking(benchmark::State& state) {
  if (skip_if_missing(state)) return;
  const Bed bed = make_bed(state);
  RandomStream rng(1);
  size_t i = 0;
  for (auto _ : state) {
    float t_hit = -1;
    sample_collisions(bed.medium, bed.rays[i++ % bed.rays.size()], infinity, 0, rng,
                      [&](float t, const MediumProperties& p, Rgb majorant, Rgb) {
                        if (rng.next_1d() * majorant.r >= p.sigma_s.r) return true;
                        t_hit = t;
                        return false;
                      });
    benchmark::DoNotOptimize(t_hit);
  }
}
BENCHMARK(BM_DeltaTracking)
    ->ArgNames({"volume", "depth_x100"})
    ->ArgsProduct({{0, 1, 2}, {44, 220, 880}});

void BM_SegmentsOnly(benchmark::State& state) {
  if (skip_if_missing(state)) return;
  const Bed bed = make_bed(state);
  size_t i = 0;
  for (auto _ : state) {
    auto segments = bed.medium.segments(bed.rays[i++ % bed.rays.size()], infinity);
    MediumSegment s;
    float sum = 0;
    while (segments.next(s)) sum += s.majorant.r;
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(BM_SegmentsOnly)
    ->ArgNames({"volume", "depth_x100"})
    ->ArgsProduct({{0, 1, 2}, {220}});

void BM_DistanceProxy(benchmark::State& state) {
  if (skip_if_missing(state)) return;
  const Bed bed = make_bed(state);
  RandomStream rng(1);
  size_t i = 0;
  for (auto _ : state) {
    const DistanceProxy proxy(bed.medium, bed.rays[i++ % bed.rays.size()], infinity);
    benchmark::DoNotOptimize(proxy.sample(rng.next_1d()));
  }
}
BENCHMARK(BM_DistanceProxy)
    ->ArgNames({"volume", "depth_x100"})
    ->ArgsProduct({{0, 1, 2}, {220}});

void BM_RandomLookup(benchmark::State& state) {
  const bool dense = state.range(0) == 0;
  const DensityGrid& grid = volume(1);
  static const BrickGrid bricks = BrickGrid::from_dense(grid);
  const Vec3i n = grid.resolution;
  RandomStream rng(1);
  for (auto _ : state) {
    const Vec3 p{rng.next_1d(), rng.next_1d(), rng.next_1d()};
    const Vec3 s{1 + p.x * 270, 1 + p.y * 270, 1 + p.z * 270};
    if (!dense) {
      benchmark::DoNotOptimize(bricks.interpolate(s));
      continue;
    }
    const int x = static_cast<int>(s.x), y = static_cast<int>(s.y),
              z = static_cast<int>(s.z);
    const float* v = &grid.values[static_cast<size_t>((z * n.y + y) * n.x + x)];
    const auto line = [&](const float* w) {
      return w[0] + (s.x - static_cast<float>(x)) * (w[1] - w[0]);
    };
    const auto plane = [&](const float* w) {
      return line(w) + (s.y - static_cast<float>(y)) * (line(w + n.x) - line(w));
    };
    const float a = plane(v), b = plane(v + n.x * n.y);
    benchmark::DoNotOptimize(a + (s.z - static_cast<float>(z)) * (b - a));
  }
}
BENCHMARK(BM_RandomLookup)->ArgName("bricks")->Arg(0)->Arg(1);

}  // namespace
}  // namespace tyndall

BENCHMARK_MAIN();
