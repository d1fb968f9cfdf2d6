// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/pixel_lattice.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace tyndall {
namespace {

using Counts = std::map<std::pair<int, int>, int>;

void count_pixels(const PixelLattice& lattice, Counts& counts) {
  for (size_t tile = 0; tile < lattice.tiles(); ++tile) {
    int64_t visits = 0;
    const int64_t told = lattice.for_pixels(tile, [&](Vec2i pixel) {
      ++counts[{pixel.x, pixel.y}];
      ++visits;
    });
    EXPECT_EQ(told, visits);
  }
}

void expect_each_once(const std::vector<PixelLattice>& lattices, Vec2i min, Vec2i max) {
  Counts counts;
  for (const PixelLattice& lattice : lattices) count_pixels(lattice, counts);
  EXPECT_EQ(counts.size(), static_cast<size_t>((max.x - min.x) * (max.y - min.y)));
  for (const auto& [pixel, count] : counts) {
    EXPECT_EQ(count, 1) << pixel.first << " " << pixel.second;
    EXPECT_TRUE(min.x <= pixel.first && pixel.first < max.x);
    EXPECT_TRUE(min.y <= pixel.second && pixel.second < max.y);
  }
}

TEST(PixelLattice, EachPixelComesOnce) {
  for (const Vec2i size : {Vec2i{1, 1}, Vec2i{8, 8}, Vec2i{33, 7}, Vec2i{100, 271}}) {
    const Vec2i min{3, 5}, max = min + size;
    expect_each_once(all_pixels(min, max), min, max);
    expect_each_once(pixels_from_coarse_to_fine(min, max), min, max);
  }
}

TEST(PixelLattice, StridesAreHalvedDownToOne) {
  for (const auto& [size, first_stride] :
       {std::pair(Vec2i{1000, 1000}, 32), std::pair(Vec2i{125, 128}, 4)}) {
    const Vec2i min{3, 5}, max = min + size;
    Counts counts;
    int stride = first_stride;
    for (const PixelLattice& lattice : pixels_from_coarse_to_fine(min, max)) {
      count_pixels(lattice, counts);
      Counts expected;
      for (int y = min.y; y < max.y; y += stride)
        for (int x = min.x; x < max.x; x += stride) expected[{x, y}] = 1;
      EXPECT_EQ(counts, expected) << stride;
      stride /= 2;
    }
    EXPECT_EQ(stride, 0);
  }
}

// An eighth of the tiles has an eighth of each quarter of the picture, up to a tenth of it.
TEST(PixelLattice, TheFirstTilesAreScattered) {
  const PixelLattice lattice = pixels_from_coarse_to_fine({0, 0}, {640, 384}).back();
  ASSERT_EQ(lattice.tiles(), 80u * 48u);
  std::map<std::pair<bool, bool>, int> tiles;
  for (size_t tile = 0; tile < lattice.tiles() / 8; ++tile) {
    Vec2i last;
    lattice.for_pixels(tile, [&](Vec2i pixel) { last = pixel; });
    ++tiles[{last.x < 320, last.y < 192}];
  }
  ASSERT_EQ(tiles.size(), 4u);
  for (const auto& [quarter, count] : tiles) EXPECT_NEAR(count, 120, 12);
}

}  // namespace
}  // namespace tyndall
