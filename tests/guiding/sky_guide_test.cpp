// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/sky_guide.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/chi_square.h"

namespace tyndall {
namespace {

const Bounds3 box{{0, 0, 0}, {4, 1, 1}};
constexpr Vec3 left{0.5f, 0.5f, 0.5f}, right{3.5f, 0.5f, 0.5f};

// Four cells in a row: the first sees a window, the last the other half of the sky.
SkyGuide two_views() {
  const CellGrid grid(box, 4);
  EXPECT_EQ(grid.count(), 4u);
  SkyGuide guide(grid);
  SkyGuide::Weights window{}, half{};
  for (size_t i = 0; i < SkyGuide::strata; ++i) {
    const size_t x = i % SkyGuide::side, y = i / SkyGuide::side;
    window[i] = x >= 3 && x < 5 && y >= 2 && y < 4 ? 7.0f : 0.0f;
    half[i] = y >= SkyGuide::side / 2 ? 0.001f : 0.0f;
  }
  guide.set(grid.find(left), window);
  guide.set(grid.find(right), half);
  guide.finish();
  return guide;
}

// The mean of points of that density.
Vec2 first_moment(const SkyGuide& guide, Vec3 p) {
  Vec2 sum{0, 0};
  constexpr int n = 64;
  for (int i = 0; i < n * n; ++i) {
    const Vec2 u{(static_cast<float>(i % n) + 0.5f) / n,
                 (static_cast<float>(i / n) + 0.5f) / n};
    sum = sum + u * (guide.pdf(p, u) / (n * n));
  }
  return sum;
}

TEST(SkyGuideTest, SamplesHaveTheirDensity) {
  const SkyGuide guide = two_views();
  for (const Vec3 p : {left, Vec3{1.5f, 0, 0}, right, Vec3{-9, 2, 0.5f}}) {
    const ChiSquareResult r = chi_square_square(
        [&](Vec2 u) -> std::optional<Vec2> { return guide.sample(p, u); },
        [&](Vec2 u) { return double{guide.pdf(p, u)}; });
    EXPECT_GT(r.p_value, sidak(0.01, 4)) << r;
    EXPECT_NEAR(r.mass, 1, 1e-4);
    EXPECT_EQ(r.samples_of_zero_pdf, 0);
    EXPECT_EQ(r.missing, 0);
    const Vec2 mean = first_moment(guide, p);
    EXPECT_GT(z_p_value(r.moments[0], double{mean.x}), 1e-3);
    EXPECT_GT(z_p_value(r.moments[1], double{mean.y}), 1e-3);
  }
}

TEST(SkyGuideTest, LooksThroughTheWindow) {
  const SkyGuide guide = two_views();
  EXPECT_GT(guide.pdf(left, {0.25f, 0.19f}), 10);
  EXPECT_LT(guide.pdf(left, {0.75f, 0.69f}), 0.2f);
  EXPECT_GT(guide.pdf(left, {0.75f, 0.69f}), 0.05f);
  EXPECT_GT(guide.pdf(right, {0.2f, 0.9f}), 1.5f);
}

// Cells between others see a little of what those see; nothing known is all alike.
TEST(SkyGuideTest, NeighboursShareWhatTheySee) {
  const SkyGuide guide = two_views();
  EXPECT_GT(guide.pdf({1.5f, 0.5f, 0.5f}, {0.25f, 0.19f}), 10);
  SkyGuide dark(CellGrid(box, 4));
  dark.finish();
  EXPECT_FLOAT_EQ(dark.pdf(left, {0.25f, 0.19f}), 1);
  SkyGuide broken(CellGrid(box, 4));
  SkyGuide::Weights weights;
  weights.fill(NAN);
  weights[5] = -1;
  weights[6] = infinity;
  broken.set(0, weights);
  broken.finish();
  EXPECT_FLOAT_EQ(broken.pdf(left, {0.25f, 0.19f}), 1);
}

}  // namespace
}  // namespace tyndall
