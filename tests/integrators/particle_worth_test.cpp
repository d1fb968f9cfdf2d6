// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/particle_worth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr double count = 3;  // particles for one sample of the only pixel

// What a walk finds at u in [0, 1] where it arrives with density one; particles arrive with
// density 2 u each.
double integrand(double u) { return 0.2 + u * u; }

double ratio(double u) { return count * 2 * u; }

// A pixel of mean one, of samples that vary by `variance`.
Film film_of(Vec2i size, double variance) {
  Film film(size, {0, 0}, size);
  const auto d = static_cast<float>(std::sqrt(variance / 2));
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      for (const float L : {1 - d, 1 + d}) {
        PathSample sample;
        sample.L = Rgb(L);
        film.add({x, y}, sample, 1);
      }
  return film;
}

const Filter& box() {
  static const Filter filter({.kind = FilterKind::box, .radius = {0.5f, 0.5f}});
  return filter;
}

// The second moments of the balance heuristic between one walk and so many particles.
double expected_moment(double particles) {
  constexpr int n = 100'000;
  double total = 0;
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) / n, f = integrand(u), q = particles * 2 * u;
    const double walk = f / (1 + q);  // weighed, over the density of one
    total += (sqr(walk) + sqr(f / (1 + q)) * q) / n;
  }
  return total;
}

TEST(ParticleWorth, MomentsAreThoseOfTheBalanceHeuristic) {
  const Film film = film_of({1, 1}, 0.5);
  const ParticleWorth worth(film, box());
  RandomStream random(5);
  std::vector<Splat> splats;
  constexpr int samples = 200'000;
  for (int i = 0; i < samples; ++i) {
    const double u = std::sqrt(double{random.next_1d()}) + 1e-9;
    const double r = ratio(u);
    const double value = integrand(u) / (2 * u) * r / (1 + r);
    splats.push_back({{0.5f, 0.5f}, Rgb(static_cast<float>(value)), static_cast<float>(r)});
  }
  const ParticleWorth::Moments moments = worth.moments(splats, count, 1);
  // Relative to the squared radiance, of three channels above and below.
  const double scale = 1.01 * count / samples;
  for (size_t i = 0; i < moments.size(); ++i) {
    const double expected = expected_moment(ParticleWorth::shares[i] * count);
    EXPECT_NEAR(moments[i] * scale, expected, 0.02 * expected) << i;
  }
}

TEST(ParticleWorth, SharesFollowGainAndCost) {
  const Film film = film_of({16, 16}, 1);
  const ParticleWorth worth(film, box());
  // Per pixel, of a variance of one: what walks alone would vary by beyond it, if anything.
  const auto share = [&](ParticleWorth::Moments moments, double cost) {
    for (double& moment : moments) moment *= 256;
    return worth.best_share(moments, 1000, cost);
  };
  EXPECT_EQ(share({0.001, 0.001, 0.001, 0.001, 0.0005}, 1000), 0);
  EXPECT_EQ(share({10, 0.1, 0.1, 0.1, 0.1}, 1000), 1.0 / 16);
  EXPECT_EQ(share({10, 3, 1, 0.1, 0.1}, 1000), 1);
  EXPECT_EQ(share({10, 9, 8, 0.9, 0.1}, 100), 4);
  // Light that only particles find.
  EXPECT_EQ(share({std::numeric_limits<double>::infinity(), 0.1, 0.1, 0.1, 0.1}, 1e6),
            1.0 / 16);
}

TEST(ParticleWorth, NothingFoundIsNothingWorth) {
  const Film film = film_of({16, 16}, 1);
  const ParticleWorth worth(film, box());
  EXPECT_EQ(worth.best_share(worth.moments({}, 100, 1), 1000, 100), 0);
}

}  // namespace
}  // namespace tyndall
