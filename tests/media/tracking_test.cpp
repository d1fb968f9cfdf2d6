// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/tracking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "media/random_media.h"
#include "support/statistical_tests.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/media/homogeneous_medium.h"

namespace tyndall {
namespace {

const Bounds3 box{{-1, 0, 2}, {1, 3, 2.5f}};

/// The first real collision of a walk driven by channel `hero`.
struct FirstCollision {
  float t = infinity;  // infinite if there is none
  Rgb weight{1};       // the channels' probability densities, relative to the hero's
};

template <typename M>
FirstCollision first_collision(const M& medium, const Ray& ray, float t_max, int hero,
                               RandomStream& rng) {
  FirstCollision found;
  const auto on_collision = [&](float t, const MediumProperties& at_t, Rgb majorant,
                                Rgb T_maj) {
    const Rgb sigma_t = at_t.sigma_t();
    found.weight *= T_maj;
    if (rng.next_1d() * majorant[hero] < sigma_t[hero]) {
      found.weight *= sigma_t / sigma_t[hero];
      found.t = t;
      return false;
    }
    found.weight *= (majorant - sigma_t) / (majorant[hero] - sigma_t[hero]);
    return true;
  };
  const Rgb rest = sample_collisions(medium, ray, t_max, hero, rng, on_collision);
  if (found.t == infinity) found.weight *= rest;
  return found;
}

class TrackingCases : public testing::TestWithParam<std::tuple<Placement, RayStart>> {};

constexpr int case_count = 7 * 4;
INSTANTIATE_TEST_SUITE_P(All, TrackingCases,
                         testing::Combine(testing::ValuesIn(all_placements),
                                          testing::ValuesIn(all_ray_starts)));

// The distances of real collisions, pushed through their distribution, are uniform.
TEST_P(TrackingCases, CollisionsFollowTheExactDistribution) {
  const auto [placement, start] = GetParam();
  RandomStream rng(hash(1, placement, start));
  const DensityGrid grid = random_grid(rng, {23, 14, 6}, GridContent::uniform_noise);
  const Transform world_from_medium = random_transform(rng, placement);
  const float size = length(world_from_medium.bounds(box).diagonal());
  const Rgb sigma_t(8 / size);
  const GridMedium medium(grid, box, world_from_medium, {Rgb(0), sigma_t, {}},
                          IsotropicPhase{});
  std::vector<double> uniforms;
  RunningMoments moment;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = random_ray(rng, start, box, world_from_medium);
    const float t_max = 8 * size;
    const auto cdf = [&](float t) {
      return 1 - std::exp(-double{sigma_t.r} * reference_optical_depth(grid, box,
                                                                       world_from_medium,
                                                                       ray, double{t}));
    };
    const float t = first_collision(medium, ray, t_max, 0, rng).t;
    // What leaves is spread over the rest of [0, 1].
    const double opacity = cdf(t_max);
    const double u =
        t == infinity ? opacity + (1 - opacity) * double{rng.next_1d()} : cdf(t);
    uniforms.push_back(u);
    moment.add(u);
  }
  EXPECT_GT(uniformity_p_value(uniforms), sidak(0.01, 2 * case_count));
  EXPECT_GT(z_p_value(moment, 0.5), sidak(0.01, 2 * case_count)) << moment.mean();
}

// Whatever channel drives the walk, its weights turn it into any other channel's: the
// expected weight of passing is that channel's transmittance, and of a collision the rest.
TEST_P(TrackingCases, WeightsTurnOneChannelIntoAnother) {
  const auto [placement, start] = GetParam();
  RandomStream rng(hash(2, placement, start));
  const DensityGrid grid = random_grid(rng, {23, 14, 6}, GridContent::mostly_empty);
  const Transform world_from_medium = random_transform(rng, placement);
  const float size = length(world_from_medium.bounds(box).diagonal());
  const Rgb sigma_t = Rgb(1, 0.8f, 0.5f) * (40 / size);
  const GridMedium medium(grid, box, world_from_medium, {Rgb(0), sigma_t, {}},
                          IsotropicPhase{});
  RunningMoments passing[3], total[3];
  for (int i = 0; i < 60; ++i) {
    const Ray ray = random_ray(rng, start, box, world_from_medium);
    const double depth =
        reference_optical_depth(grid, box, world_from_medium, ray, 8 * double{size});
    for (int k = 0; k < 200; ++k) {
      const FirstCollision found = first_collision(medium, ray, 8 * size, 1, rng);
      for (int c = 0; c < 3; ++c) {
        const double weight = double{found.weight[c]};
        passing[c].add((found.t == infinity ? weight : 0) -
                       std::exp(-double{sigma_t[c]} * depth));
        total[c].add(weight - 1);
      }
    }
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_GT(z_p_value(passing[c], 0), sidak(0.01, 5 * case_count))
        << passing[c].mean() << " +- " << passing[c].standard_error();
  EXPECT_GT(z_p_value(total[0], 0), sidak(0.01, 5 * case_count)) << total[0].mean();
  EXPECT_GT(z_p_value(total[2], 0), sidak(0.01, 5 * case_count)) << total[2].mean();
}

TEST(TrackingTest, HomogeneousMediaHaveNoNullCollisions) {
  RandomStream rng(1);
  const HomogeneousMedium medium({{0.5f, 0.25f, 0}, {0.5f, 0.25f, 0}, {}},
                                 IsotropicPhase{});
  RunningMoments distance;
  for (int i = 0; i < 100'000; ++i) {
    int collisions = 0;
    sample_collisions(medium, {{0, 0, 0}, {1, 0, 0}}, infinity, 0, rng,
                      [&](float t, const MediumProperties& p, Rgb majorant, Rgb T_maj) {
                        EXPECT_EQ(majorant, p.sigma_t());
                        EXPECT_NEAR(T_maj.g, std::exp(0.5f * t), 1e-5f * T_maj.g);
                        EXPECT_NEAR(T_maj.b, std::exp(t), 1e-5f * T_maj.b);
                        EXPECT_EQ(T_maj.r, 1);
                        distance.add(double{t});
                        ++collisions;
                        return false;
                      });
    ASSERT_EQ(collisions, 1);
  }
  EXPECT_GT(z_p_value(distance, 1), 0.01) << distance.mean();
}

// A hero that cannot collide passes; the other channels know how unlikely that was.
TEST(TrackingTest, HeroWithoutMajorantPasses) {
  RandomStream rng(2);
  const HomogeneousMedium medium({{0, 1, 0}, {0, 1, 0}, {}}, IsotropicPhase{});
  const auto fail = [](float, const MediumProperties&, Rgb, Rgb) {
    ADD_FAILURE() << "collision";
    return false;
  };
  const Ray ray{{0, 0, 0}, {0, 1, 0}};
  const Rgb T_maj = sample_collisions(medium, ray, 1.5f, 0, rng, fail);
  EXPECT_EQ(T_maj.r, 1);
  EXPECT_FLOAT_EQ(T_maj.g, std::exp(-3.0f));
  EXPECT_EQ(sample_collisions(medium, ray, infinity, 2, rng, fail), Rgb(1, 0, 1));
}

TEST(TrackingTest, GreyMediaHaveUnitRelativeTransmittance) {
  RandomStream rng(3);
  const DensityGrid grid = random_grid(rng, {8, 8, 8}, GridContent::uniform_noise);
  const GridMedium medium(grid, box, Transform(), {Rgb(1), Rgb(3), {}}, IsotropicPhase{});
  for (int i = 0; i < 100; ++i) {
    const Ray ray = random_ray(rng, RayStart::outside, box, Transform());
    const Rgb rest = sample_collisions(medium, ray, infinity, i % 3, rng,
                                       [](float, const MediumProperties&, Rgb, Rgb T_maj) {
                                         EXPECT_EQ(T_maj, Rgb(1));
                                         return true;
                                       });
    EXPECT_EQ(rest, Rgb(1));
  }
}

// A constant grid without its border is a homogeneous medium.
TEST(TrackingTest, ConstantGridIsHomogeneous) {
  RandomStream rng(4);
  const DensityGrid grid = random_grid(rng, {40, 40, 40}, GridContent::constant);
  const GridMedium constant(grid, {{-1, -1, -1}, {1, 1, 1}}, Transform(),
                            {Rgb(0.5f), Rgb(1.5f), {}}, IsotropicPhase{});
  const HomogeneousMedium homogeneous({Rgb(0.5f), Rgb(1.5f), {}}, IsotropicPhase{});
  RunningMoments a, b;
  for (int i = 0; i < 100'000; ++i) {
    const float cos_theta = uniform(rng, -1, 1);
    const Vec3 d = spherical_direction(cos_theta, uniform(rng, 0, 2 * pi));
    const float t_max = 0.9f;
    a.add(
        std::min(double{first_collision(constant, {{0, 0, 0}, d}, t_max, 0, rng).t}, 1.0));
    b.add(std::min(double{first_collision(homogeneous, {{0, 0, 0}, d}, t_max, 0, rng).t},
                   1.0));
  }
  EXPECT_GT(welch_p_value(a, b), 0.01) << a.mean() << " and " << b.mean();
}

}  // namespace
}  // namespace tyndall
