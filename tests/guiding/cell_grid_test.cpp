// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/cell_grid.h"

#include <gtest/gtest.h>

#include <set>

namespace tyndall {
namespace {

const Bounds3 box{{-1, 0, 2}, {3, 2, 3}};

TEST(CellGridTest, CellsAreNearlyCubes) {
  const CellGrid grid(box, 4096);
  EXPECT_EQ(grid.size(0), 32);
  EXPECT_EQ(grid.size(1), 16);
  EXPECT_EQ(grid.size(2), 8);
  EXPECT_EQ(grid.count(), 4096u);
}

TEST(CellGridTest, MiddlesLieInTheirCells) {
  for (const Bounds3& bounds :
       {box, Bounds3{{0, 0, 0}, {4, 4, 0}}, Bounds3{{1, 1, 1}, {1, 1, 1}}}) {
    const CellGrid grid(bounds, 1000);
    EXPECT_LE(grid.count(), 4000u);
    std::set<size_t> cells;
    for (int z = 0; z < grid.size(2); ++z)
      for (int y = 0; y < grid.size(1); ++y)
        for (int x = 0; x < grid.size(0); ++x) {
          const Vec3 p = grid.middle(x, y, z);
          EXPECT_TRUE(bounds.contains(p));
          if (bounds.min != bounds.max) {
            EXPECT_EQ(grid.find(p), grid.index(x, y, z));
          }
          cells.insert(grid.index(x, y, z));
        }
    EXPECT_EQ(cells.size(), grid.count());
    EXPECT_EQ(*cells.rbegin(), grid.count() - 1);
  }
}

TEST(CellGridTest, BeyondTheBoxIsTheNearestCell) {
  const CellGrid grid(box, 512);
  EXPECT_EQ(grid.find({100, 200, 300}), grid.count() - 1);
  EXPECT_EQ(grid.find({-100, -1, -1}), 0u);
  EXPECT_EQ(grid.find({0.3f, 9, 2.2f}), grid.find({0.3f, 1.99f, 2.2f}));
}

}  // namespace
}  // namespace tyndall
