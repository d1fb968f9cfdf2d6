// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <vector>

#include "tyndall/sampling/random.h"
#include "tyndall/techniques/binned_distance.h"
#include "tyndall/techniques/double_scattering_direction.h"
#include "tyndall/techniques/double_scattering_distance.h"
#include "tyndall/techniques/equiangular.h"
#include "tyndall/techniques/exponential_distance.h"
#include "tyndall/techniques/point_normal.h"
#include "tyndall/techniques/single_scattering_distance.h"

namespace tyndall {
namespace {

/// Everything that a technique is built from and asked, different in every iteration.
struct Query {
  Ray ray;
  Vec3 pivot;
  float t_max;
  float u[6];
};

const std::vector<Query>& queries() {
  static const std::vector<Query> all = [] {
    RandomStream random(1);
    const auto point = [&](float size) {
      return Vec3{random.next_1d() - 0.5f, random.next_1d() - 0.5f,
                  random.next_1d() - 0.5f} *
             size;
    };
    std::vector<Query> result(4096);
    for (Query& q : result) {
      q.ray = {point(10), normalize(point(1))};
      q.pivot = point(6);
      q.t_max = 3 + 12 * random.next_1d();
      for (float& u : q.u) u = random.next_1d();
    }
    return result;
  }();
  return all;
}

/// Runs f on one query after the other.
template <typename F>
void run(benchmark::State& state, const F& f) {
  const std::vector<Query>& all = queries();
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(f(all[i]));
    i = (i + 1) % all.size();
  }
  state.SetItemsProcessed(state.iterations());
}

/// A technique built and sampled, with the density of the sample; and built and asked for
/// the density elsewhere.
template <typename Make>
void run_distance(benchmark::State& state, const Make& make) {
  if (state.range(0) == 0) {
    run(state, [&](const Query& q) {
      const auto sample = make(q).sample(q.u[0]);
      return sample ? sample->t / sample->pdf_t : 0;
    });
  } else {
    run(state, [&](const Query& q) { return make(q).pdf_t(q.u[0] * q.t_max); });
  }
}

const ScatteringTables& tables(int64_t g_percent) {
  static const ScatteringTables isotropic(0), forward(0.75f);
  return g_percent == 0 ? isotropic : forward;
}

void BM_Equiangular(benchmark::State& state) {
  run_distance(state, [](const Query& q) {
    return EquiangularSampling(q.ray, q.pivot, 0, q.t_max);
  });
}
BENCHMARK(BM_Equiangular)->ArgName("pdf")->Arg(0)->Arg(1);

void BM_PointNormal(benchmark::State& state) {
  run_distance(state, [](const Query& q) {
    return PointNormalSampling(q.ray, q.pivot, {0, 0.6f, 0.8f}, 0, q.t_max);
  });
}
BENCHMARK(BM_PointNormal)->ArgName("pdf")->Arg(0)->Arg(1);

void BM_Exponential(benchmark::State& state) {
  run_distance(state,
               [](const Query& q) { return ExponentialDistance(q.u[1], 0, q.t_max); });
}
BENCHMARK(BM_Exponential)->ArgName("pdf")->Arg(0)->Arg(1);

void BM_SingleScattering(benchmark::State& state) {
  const ScatteringTables& table = tables(state.range(1));
  run_distance(state, [&](const Query& q) {
    return SingleScatteringDistance(table, q.ray, q.pivot, 0, q.t_max);
  });
}
BENCHMARK(BM_SingleScattering)->ArgNames({"pdf", "g"})->ArgsProduct({{0, 1}, {0, 75}});

void BM_DoubleScattering(benchmark::State& state) {
  const ScatteringTables& table = tables(state.range(1));
  run_distance(state, [&](const Query& q) {
    return DoubleScatteringDistance(table, q.ray, q.pivot, 0, q.t_max);
  });
}
BENCHMARK(BM_DoubleScattering)->ArgNames({"pdf", "g"})->ArgsProduct({{0, 1}, {0, 75}});

void BM_DoubleScatteringDirection(benchmark::State& state) {
  const ScatteringTables& table = tables(state.range(1));
  const auto make = [&](const Query& q) {
    return DoubleScatteringDirection(table, q.ray.o, q.ray.d, q.pivot);
  };
  if (state.range(0) == 0) {
    run(state, [&](const Query& q) {
      const auto sample = make(q).sample({q.u[0], q.u[1]});
      return sample ? sample->w.x / sample->pdf : 0;
    });
  } else {
    run(state, [&](const Query& q) { return make(q).pdf(q.ray.d); });
  }
}
BENCHMARK(BM_DoubleScatteringDirection)
    ->ArgNames({"pdf", "g"})
    ->ArgsProduct({{0, 1}, {0, 75}});

/// Two vertices from a ray to a light, all densities included, rays not: what an integrator
/// pays for a three-connection besides tracing.
void BM_ThreeConnection(benchmark::State& state) {
  const ScatteringTables& table = tables(state.range(0));
  run(state, [&](const Query& q) {
    const auto t =
        DoubleScatteringDistance(table, q.ray, q.pivot, 0, q.t_max).sample(q.u[0]);
    if (!t) return 0.0f;
    const Vec3 b = q.ray.at(t->t);
    const auto w =
        DoubleScatteringDirection(table, b, q.ray.d, q.pivot).sample({q.u[1], q.u[2]});
    if (!w) return 0.0f;
    const auto s =
        SingleScatteringDistance(table, {b, w->w}, q.pivot, 0, q.t_max).sample(q.u[3]);
    if (!s) return 0.0f;
    const Vec3 c = b + w->w * s->t;
    return 1 / (distance_squared(c, q.pivot) * t->pdf_t * w->pdf * s->pdf_t);
  });
}
BENCHMARK(BM_ThreeConnection)->ArgName("g")->Arg(0)->Arg(75);

template <typename Base>
auto binned(const Base& base, float sigma_t, float g) {
  const auto taps = base.template taps<64>();
  auto weights = DistanceWeights<64>::ones();
  weights.multiply_transmittance(taps, sigma_t).multiply_phase(taps, g);
  return BinnedDistance<Base, 32>(base, weights, 0.05f);
}

/// The distance technique with transmittance and phase function in 32 bins of two taps.
void BM_BinnedBuild(benchmark::State& state) {
  const float g = static_cast<float>(state.range(0)) / 100;
  run(state, [&](const Query& q) {
    return binned(EquiangularSampling(q.ray, q.pivot, 0, q.t_max), q.u[1], g);
  });
}
BENCHMARK(BM_BinnedBuild)->ArgName("g")->Arg(0)->Arg(75);

void BM_BinnedDoubleBuild(benchmark::State& state) {
  const ScatteringTables& table = tables(0);
  run(state, [&](const Query& q) {
    return binned(DoubleScatteringDistance(table, q.ray, q.pivot, 0, q.t_max), q.u[1], 0);
  });
}
BENCHMARK(BM_BinnedDoubleBuild);

void BM_BinnedSample(benchmark::State& state) {
  const Query& first = queries().front();
  const auto technique =
      binned(EquiangularSampling(first.ray, first.pivot, 0, first.t_max), 0.3f, 0);
  if (state.range(0) == 0) {
    run(state, [&](const Query& q) { return technique.sample(q.u[0]); });
  } else {
    run(state, [&](const Query& q) { return technique.pdf_t(q.u[0] * first.t_max); });
  }
}
BENCHMARK(BM_BinnedSample)->ArgName("pdf")->Arg(0)->Arg(1);

void BM_BuildTables(benchmark::State& state) {
  float g = 0.5f;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ScatteringTables(g));
    g = g < 0.9f ? g + 0.01f : 0.5f;
  }
}
BENCHMARK(BM_BuildTables)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tyndall

BENCHMARK_MAIN();
