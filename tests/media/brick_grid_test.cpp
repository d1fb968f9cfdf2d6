// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/brick_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "media/random_media.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/media/majorant_grid.h"

namespace tyndall {
namespace {

constexpr Vec3i bricks{5, 4, 3};

// Values of samples, from the noise and the brick that they lie in: some constant, some
// empty, some with one giant.
float value_at(Vec3i p) {
  const uint64_t brick = hash(p.x >> 3, p.y >> 3, p.z >> 3) % 5;
  const float noise = uniform_float(static_cast<uint32_t>(hash(p.x, p.y, p.z) >> 32));
  if (brick == 0) return 0;
  if (brick == 1) return 0.3f;
  if (brick == 2) return std::exp(40 * noise - 20);
  return noise;
}

bool fill(Vec3i brick, BrickGrid::Samples samples) {
  size_t i = 0;
  for (int z = 0; z <= 8; ++z)
    for (int y = 0; y <= 8; ++y)
      for (int x = 0; x <= 8; ++x)
        samples[i++] = value_at({8 * brick.x + x, 8 * brick.y + y, 8 * brick.z + z});
  return true;
}

float largest_of_brick(Vec3i brick) {
  std::array<float, BrickGrid::brick_size> samples;
  fill(brick, samples);
  return *std::max_element(samples.begin(), samples.end());
}

Vec3 to_float(Vec3i p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

TEST(CompactBrickGridTest, SamplesAreWithinOneStep) {
  const BrickGrid exact(bricks, fill);
  const BrickGrid compact(bricks, fill, BrickGrid::Precision::compact);
  EXPECT_LT(compact.memory(), exact.memory() * 6 / 10);
  EXPECT_EQ(compact.maximum(), exact.maximum());
  for (int z = 0; z < 8 * bricks.z; ++z)
    for (int y = 0; y < 8 * bricks.y; ++y)
      for (int x = 0; x < 8 * bricks.x; ++x) {
        const float expected = value_at({x, y, z});
        ASSERT_EQ(exact.interpolate(to_float({x, y, z})), expected);
        const float found = compact.interpolate(to_float({x, y, z}));
        const float step = largest_of_brick({x >> 3, y >> 3, z >> 3}) / 65535;
        ASSERT_NEAR(found, expected, 0.5f * step + 2e-7f * expected);
        if (expected == 0) {
          ASSERT_EQ(found, 0);
        }
      }
}

TEST(CompactBrickGridTest, ConstantBricksAreExactAndShared) {
  const auto constant = [](Vec3i brick, BrickGrid::Samples samples) {
    std::fill(samples.begin(), samples.end(), brick.x < 2 ? 0.3f : 1e-7f);
    return true;
  };
  const BrickGrid grid({40, 20, 20}, constant, BrickGrid::Precision::compact);
  EXPECT_EQ(grid.interpolate({3.3f, 4.4f, 5.5f}), 0.3f);
  EXPECT_EQ(grid.interpolate({300.3f, 140.4f, 5.5f}), 1e-7f);
  EXPECT_LT(grid.memory(), 40 * 20 * 20 * 8 + 3 * 1500);
}

TEST(BrickGridTest, SlabsArePreparedInOrder) {
  int expected = 0;
  BrickGrid({37, 1, 2}, fill, BrickGrid::Precision::exact, [&](int first, int last) {
    EXPECT_EQ(first, expected);
    EXPECT_GT(last, first);
    expected = last;
  });
  EXPECT_EQ(expected, 37);
}

class BoundsTest : public testing::TestWithParam<Placement> {};

INSTANTIATE_TEST_SUITE_P(All, BoundsTest,
                         testing::Values(Placement::identity, Placement::rotated,
                                         Placement::sheared, Placement::mirrored,
                                         Placement::tiny, Placement::huge));

// Of what a medium of compact samples really interpolates, not of what it was made from.
TEST_P(BoundsTest, MajorantsHoldAlongRays) {
  RandomStream rng(hash(5, GetParam()));
  const auto grid =
      std::make_shared<BrickGrid>(bricks, fill, BrickGrid::Precision::compact);
  const Bounds3 box{{0, 0, 0},
                    to_float({8 * bricks.x - 1, 8 * bricks.y - 1, 8 * bricks.z - 1})};
  const Transform world_from_medium = random_transform(rng, GetParam());
  const GridMedium medium({{Transform(), box}, grid}, world_from_medium,
                          {Rgb(0), Rgb(1), Rgb(0)}, IsotropicPhase{});
  // All of a stretch through the corner of a cell is near its ends.
  const float corner = 3e-3f * length(world_from_medium.vector({1, 0, 0}));
  int segment_count = 0;
  for (int i = 0; i < 400; ++i) {
    const RayStart start = all_ray_starts[i % 4];
    auto segments =
        medium.segments(random_ray(rng, start, box, world_from_medium), infinity);
    MediumSegment s;
    for (; segments.next(s); ++segment_count)
      for (int k = 1; k < 100; ++k) {
        // Within the cell, beyond the reach of rounding at its faces.
        const float f = 0.01f + 0.98f * static_cast<float>(k) / 100;
        const float x = s.t_min + (s.t_max - s.t_min) * f;
        const bool is_near_end = k < 5 || k > 95 || s.t_max - s.t_min < corner;
        const float slack = is_near_end ? 1e-3f * grid->maximum() : 0;
        ASSERT_LE(segments.density(x), s.majorant.r * 1.00001f + slack);
      }
  }
  EXPECT_GT(segment_count, 1000);
}

// Every cell's bound is reached by a sample: tight, too.
TEST(MajorantGridTest, BoundsCompactCellsTightly) {
  const BrickGrid grid(bricks, fill, BrickGrid::Precision::compact);
  const MajorantGrid majorants(grid);
  const int edge = static_cast<int>(majorants.cell_edge());
  RandomStream rng(6);
  const Vec3i n = majorants.resolution();
  for (int cz = 0; cz < n.z; ++cz)
    for (int cy = 0; cy < n.y; ++cy)
      for (int cx = 0; cx < n.x; ++cx) {
        const float bound = majorants.cell({cx, cy, cz}).majorant;
        const Vec3 low = to_float({cx * edge, cy * edge, cz * edge});
        float highest = 0;
        const auto look = [&](Vec3 offset) {
          const Vec3 p = low + offset * (static_cast<float>(edge) * 0.999999f);
          const float value = grid.interpolate(p);
          ASSERT_LE(value, bound);
          highest = std::max(highest, value);
        };
        for (int i = 0; i < 500; ++i) look({rng.next_1d(), rng.next_1d(), rng.next_1d()});
        for (int k = 0; k <= edge; ++k)
          for (int j = 0; j <= edge; ++j)
            for (int i = 0; i <= edge; ++i)
              look(to_float({i, j, k}) / static_cast<float>(edge));
        EXPECT_GE(highest, bound * 0.999f);
      }
}

}  // namespace
}  // namespace tyndall
