// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/grid_medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "media/random_media.h"

namespace tyndall {
namespace {

const Bounds3 box{{-1, 0, 2}, {1, 3, 2.5f}};
const MediumProperties red{{0.5f, 0.2f, 0.1f}, {1, 2, 0}, {}};

GridMedium make_medium(const DensityGrid& grid, const Transform& world_from_medium) {
  return {grid, box, world_from_medium, red, IsotropicPhase{}};
}

class PlacedGridTest
    : public testing::TestWithParam<std::tuple<GridContent, Placement, RayStart>> {
 protected:
  GridContent content() const { return std::get<0>(GetParam()); }
  Placement placement() const { return std::get<1>(GetParam()); }
  RayStart start() const { return std::get<2>(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(
    All, PlacedGridTest,
    testing::Combine(testing::Values(GridContent::uniform_noise, GridContent::mostly_empty,
                                     GridContent::dynamic_range, GridContent::constant),
                     testing::ValuesIn(all_placements), testing::ValuesIn(all_ray_starts)));

TEST_P(PlacedGridTest, SegmentsCoverTheDensityAndBoundIt) {
  RandomStream rng(hash(1, content(), placement(), start()));
  for (int repetition = 0; repetition < 4; ++repetition) {
    const Vec3i resolution{3 + static_cast<int>(rng.next_bits() % 40),
                           1 + static_cast<int>(rng.next_bits() % 20), 17};
    const DensityGrid grid = random_grid(rng, resolution, content());
    const Transform world_from_medium = random_transform(rng, placement());
    const GridMedium medium = make_medium(grid, world_from_medium);
    const Vec3 size = world_from_medium.bounds(box).diagonal();
    for (int i = 0; i < 10; ++i) {
      const Ray ray = random_ray(rng, start(), box, world_from_medium);
      const float t_end = 8 * length(size);
      auto segments = medium.segments(ray, t_end);
      MediumSegment s;
      float t = 0;
      const auto expect_empty = [&](float from, float to) {
        if (!(to - from > 1e-4f * t_end)) return;
        for (int k = 1; k < 20; ++k) {
          const float x = from + (to - from) * static_cast<float>(k) / 20;
          if (std::min(x - from, to - x) < 1e-5f * t_end) continue;
          EXPECT_EQ(medium.at(ray.at(x)).sigma_t(), Rgb(0)) << "in a gap, at " << x;
        }
      };
      while (segments.next(s)) {
        ASSERT_GE(s.t_min, t);
        ASSERT_GE(s.t_max, s.t_min);
        ASSERT_LE(s.t_max, t_end);
        for (int c = 0; c < 3; ++c) {
          ASSERT_GE(s.majorant[c], s.mean[c]);
          ASSERT_EQ(s.mean[c] > 0, red.sigma_t()[c] > 0);
        }
        expect_empty(t, s.t_min);
        for (int k = 0; k <= 50; ++k) {
          const float x = s.t_min + (s.t_max - s.t_min) * static_cast<float>(k) / 50;
          const Rgb sigma_t = segments.at(x).sigma_t();
          for (int c = 0; c < 3; ++c) ASSERT_LE(sigma_t[c], s.majorant[c] * 1.000001f);
        }
        t = s.t_max;
      }
      expect_empty(t, t_end);
    }
  }
}

// Segments::at() clamps to the majorant; the density itself must not need it.
TEST_P(PlacedGridTest, MajorantsHoldWithoutClamping) {
  if (placement() == Placement::far_away) return;  // positions in float are too coarse
  RandomStream rng(hash(2, content(), placement(), start()));
  const DensityGrid grid = random_grid(rng, {70, 20, 9}, content());
  const Transform world_from_medium = random_transform(rng, placement());
  const GridMedium medium = make_medium(grid, world_from_medium);
  for (int i = 0; i < 50; ++i) {
    const Ray ray = random_ray(rng, start(), box, world_from_medium);
    auto segments = medium.segments(ray, infinity);
    const float corner = 3e-3f * length(world_from_medium.vector(box.diagonal())) / 70;
    MediumSegment s;
    while (segments.next(s)) {
      const float majorant = s.majorant.r / red.sigma_t().r;
      for (int k = 1; k < 50; ++k) {
        const float f = static_cast<float>(k) / 50;
        const float x = s.t_min + (s.t_max - s.t_min) * f;
        // Near its ends rounding may push a point into the next cell; all of a stretch
        // through the corner of a cell is near them.
        const bool is_near_end = f < 0.05f || f > 0.95f || s.t_max - s.t_min < corner;
        const float slack = is_near_end ? 1e-3f * largest_value(grid) : 0;
        ASSERT_LE(segments.density(x), majorant * 1.00001f + slack);
      }
    }
  }
}

// How much the density may change for rounding: the medium finds a point of the world in
// its own space by a product of matrices, each sum of which may be off by two units of
// roundoff of its terms, and the density changes at most by `maximum` from one sample to
// the next.
double rounding_error(const Transform& world_from_medium, Vec3 p_world, Vec3i resolution,
                      double maximum) {
  const double roundoff = 0.5 * double{std::numeric_limits<float>::epsilon()};
  const int counts[] = {resolution.x, resolution.y, resolution.z};
  double samples = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& row = world_from_medium.inverse_matrix()[static_cast<size_t>(axis)];
    double terms = std::abs(double{row[3]}) + std::abs(double{box.min[axis]});
    for (int k = 0; k < 3; ++k)
      terms += std::abs(double{row[static_cast<size_t>(k)]} * double{p_world[k]});
    samples += 2 * roundoff * terms * counts[axis] / double{box.diagonal()[axis]};
  }
  return maximum * (samples + 2 * roundoff);
}

TEST_P(PlacedGridTest, InterpolatesAsDefined) {
  RandomStream rng(hash(3, content(), placement(), start()));
  const DensityGrid grid = random_grid(rng, {21, 9, 14}, content());
  const Transform world_from_medium = random_transform(rng, placement());
  const GridMedium medium = make_medium(grid, world_from_medium);
  const double maximum = double{largest_value(grid)};
  const double opaque = double{
      opaque_density(max_component(red.sigma_t()), medium.placement().world_from_grid())};
  for (int i = 0; i < 200; ++i) {
    const Vec3 p =
        box.min + box.diagonal() * Vec3{rng.next_1d(), rng.next_1d(), rng.next_1d()};
    const Vec3 p_world = world_from_medium.point(p);
    const double expected =
        std::min(reference_density(grid, box, world_from_medium, p_world), opaque);
    const double error =
        rounding_error(world_from_medium, p_world, grid.resolution, maximum);
    const MediumProperties found = medium.at(p_world);
    EXPECT_NEAR(found.sigma_s.g, 2 * expected, 2 * error);
    EXPECT_NEAR(found.sigma_a.r, 0.5 * expected, 0.5 * error);
    EXPECT_EQ(found.sigma_s.b, 0);
  }
}

}  // namespace
}  // namespace tyndall
