// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/exposure_grid.h"

#include <gtest/gtest.h>

#include <array>

namespace tyndall {
namespace {

const Bounds3 box{{-1, 0, 2}, {3, 2, 3}};

ExposureGrid measured(int cells, float (*exposure)(Vec3)) {
  const CellGrid at(box, cells);
  ExposureGrid grid(at, 0.01f);
  for (int z = 0; z < at.size(2); ++z)
    for (int y = 0; y < at.size(1); ++y)
      for (int x = 0; x < at.size(0); ++x)
        grid.set(at.index(x, y, z), exposure(at.middle(x, y, z)));
  grid.finish();
  return grid;
}

TEST(ExposureGridTest, IsWhatWasMeasuredRelativeToTheBrightest) {
  const ExposureGrid grid = measured(4096, [](Vec3 p) { return 5 * (p.x + 1); });
  const float brightest = 4 - 0.5f * 4 / 32;  // in the middle of the last cell
  for (const float x : {-0.5f, 0.0f, 1.3f, 2.5f})
    EXPECT_NEAR(grid.exposure({x, 1.1f, 2.4f}), (x + 1) / brightest, 1e-4f) << x;
  EXPECT_FLOAT_EQ(grid.exposure({3, 1, 2.5f}), 1);
}

TEST(ExposureGridTest, OutsideIsAsAtTheBorder) {
  const ExposureGrid grid = measured(512, [](Vec3 p) { return p.x + p.y + p.z; });
  EXPECT_FLOAT_EQ(grid.exposure({100, 200, 300}), grid.exposure({3, 2, 3}));
  EXPECT_FLOAT_EQ(grid.exposure({-100, 1, 2}), grid.exposure({-1, 1, 2}));
}

TEST(ExposureGridTest, ABatchIsItsPoints) {
  const ExposureGrid grid = measured(1000, [](Vec3 p) { return p.y * p.z; });
  const Ray ray{{-2, 0, 2}, normalize(Vec3{1, 0.4f, 0.2f})};
  const std::array<float, 4> t{0, 1, 2.5f, 9};
  std::array<float, 4> out;
  grid.exposure(ray, t, out);
  for (size_t i = 0; i < t.size(); ++i) EXPECT_EQ(out[i], grid.exposure(ray.at(t[i])));
}

TEST(ExposureGridTest, NeverFallsBelowItsFloor) {
  EXPECT_EQ(
      measured(64, [](Vec3 p) { return p.x < 1 ? -1.0f : 1.0f; }).exposure({-1, 1, 2.5f}),
      0.01f);
  const ExposureGrid dark = measured(64, [](Vec3) { return 0.0f; });
  EXPECT_EQ(dark.exposure({0, 1, 2.5f}), 1);  // nothing is known
  EXPECT_EQ(measured(64, [](Vec3) { return NAN; }).exposure({0, 1, 2.5f}), 1);
}

TEST(ExposureGridTest, FlatBoxesWork) {
  for (const Bounds3& bounds :
       {Bounds3{{0, 0, 0}, {4, 4, 0}}, Bounds3{{1, 1, 1}, {1, 1, 1}}}) {
    const CellGrid at(bounds, 1000);
    ExposureGrid grid(at, 0.01f);
    for (size_t cell = 0; cell < at.count(); ++cell) grid.set(cell, 3);
    grid.finish();
    EXPECT_EQ(grid.memory(), at.count() * sizeof(float));
    EXPECT_EQ(grid.exposure(bounds.center()), 1);
  }
}

}  // namespace
}  // namespace tyndall
