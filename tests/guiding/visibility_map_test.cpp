// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/visibility_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "guiding/plate.h"
#include "tyndall/guiding/optical_depth_map.h"
#include "tyndall/math/statistics.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

const Plate plate = perforated_plate();
const Bounds3 bounds{{-2, -2, -1}, {2, 2, 2}};

VisibilityMap::Trace trace_plate() {
  return [](const Ray& ray, Vec2) { return plate.distance(ray); };
}

VisibilityMap traced(const LightView& view, int resolution = 256,
                     const VisibilityMap::Trace& trace = trace_plate()) {
  VisibilityMapSettings settings;
  settings.resolution = resolution;
  VisibilityMap map(view, settings);
  map.trace_rows(0, map.rows(), trace);
  map.finish();
  return map;
}

Vec3 random_point(RandomStream& random) {
  const Vec3 u{random.next_1d(), random.next_1d(), random.next_1d()};
  return bounds.min + u * bounds.diagonal();
}

/// How well a map predicts: shares of right answers where the plate lights or hides a
/// point.
struct Score {
  double lit, dark;
};

Score score(const VisibilityMap& map, const std::function<bool(Vec3)>& is_visible) {
  RandomStream random(7);
  RunningMoments lit, dark;
  for (int i = 0; i < 50'000; ++i) {
    const Vec3 p = random_point(random);
    const float v = map.visibility(p);
    if (is_visible(p))
      lit.add(v);
    else
      dark.add((1 - v) / (1 - map.floor()));
  }
  return {lit.mean(), dark.mean()};
}

TEST(VisibilityMapTest, PredictsThePlateForAPointLight) {
  const Vec3 light{0, 0, 0};
  const Score s = score(traced(LightView::around(light)),
                        [&](Vec3 p) { return plate.is_visible(light, p); });
  EXPECT_GT(s.lit, 0.985);
  EXPECT_GT(s.dark, 0.985);
}

TEST(VisibilityMapTest, ASketchFindsTheEdgesWithFewRays) {
  const Vec3 light{0, 0, 0};
  VisibilityMapSettings settings;
  settings.resolution = 512;
  settings.edge_depth = 0.5f;
  VisibilityMap map(LightView::around(light), settings);
  int rays = 0;
  const auto trace = [&](const Ray& ray, Vec2) {
    ++rays;
    return plate.distance(ray);
  };
  for (int row = 0; row < map.sketch_rows(); ++row) map.sketch_row(row, trace);
  map.refine_rows(0, 200, trace);
  map.refine_rows(200, 512, trace);
  map.finish();
  const Score s = score(map, [&](Vec3 p) { return plate.is_visible(light, p); });
  EXPECT_GT(s.lit, 0.985);
  EXPECT_GT(s.dark, 0.985);
  EXPECT_LT(rays, 0.4 * 512 * 512 * 4);
}

TEST(VisibilityMapTest, PredictsThePlateForASpot) {
  const Vec3 light{0, 0, 0}, axis = normalize(Vec3{0.2f, 0, 1});
  const float cos_total = 0.7f;
  const VisibilityMap map = traced(LightView::cone(light, axis, cos_total));
  RandomStream random(8);
  int right = 0, inside = 0;
  for (int i = 0; i < 50'000; ++i) {
    const Vec3 p = random_point(random);
    if (dot(normalize(p), axis) < cos_total) continue;
    ++inside;
    right += (map.visibility(p) > 0.5f) == plate.is_visible(light, p) ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(right, 0.98 * inside);
  EXPECT_EQ(map.visibility({0, 0, -1}), map.floor());
  VisibilityMapSettings settings;
  settings.resolution = 8;
  settings.lit_outside = true;
  EXPECT_EQ(VisibilityMap(map.view(), settings).visibility({0, 0, -1}), 1);
}

TEST(VisibilityMapTest, PredictsThePlateForParallelLight) {
  const Vec3 wi = normalize(Vec3{0.1f, -0.2f, -1});
  const Score s = score(traced(LightView::parallel(wi, bounds)),
                        [&](Vec3 p) { return plate.is_visible(p + wi * 10, p); });
  EXPECT_GT(s.lit, 0.985);
  EXPECT_GT(s.dark, 0.95);
}

// Half shadows of an area light: the mean over many points, against the share of its area.
TEST(VisibilityMapTest, PredictsThePenumbraOfASmallAreaLight) {
  const float side = 0.06f;
  const auto trace = [&](const Ray& ray, Vec2 u) {
    return plate.distance({{side * (u.x - 0.5f), side * (u.y - 0.5f), 0}, ray.d});
  };
  const VisibilityMap map = traced(LightView::around({0, 0, 0}), 128, trace);
  RandomStream random(9);
  RunningMoments error, squared;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = random_point(random);
    if (p.z < 0.55f) continue;
    double share = 0;
    for (int k = 0; k < 16; ++k) {
      const Vec2 u = random.next_2d();
      share +=
          plate.is_visible({side * (u.x - 0.5f), side * (u.y - 0.5f), 0}, p) ? 1.0 / 16 : 0;
    }
    const double v = (static_cast<double>(map.visibility(p)) - 0.05) / 0.95;
    error.add(v - share);
    squared.add((v - share) * (v - share));
  }
  EXPECT_NEAR(error.mean(), 0, 0.01);
  EXPECT_LT(std::sqrt(squared.mean()), 0.12);
}

TEST(VisibilityMapTest, ABatchIsItsPoints) {
  const VisibilityMap map = traced(LightView::around({0, 0, 0}), 64);
  const Ray ray{{-1, -1, 1}, normalize(Vec3{1, 0.9f, -0.2f})};
  std::vector<float> t(150), out(150);
  for (size_t i = 0; i < t.size(); ++i) t[i] = 0.003f + 0.02f * static_cast<float>(i);
  for (const int level : {0, 3}) {
    map.visibility(ray, t, out, level);
    int different = 0;
    for (size_t i = 0; i < t.size(); ++i)
      different += out[i] == map.visibility(ray.at(t[i]), level) ? 0 : 1;
    EXPECT_LE(different, 1);  // points that rounding puts on the border of two texels
  }
}

// A coarser level predicts the mean of the finer one.
TEST(VisibilityMapTest, CoarseLevelsPredictMeans) {
  const VisibilityMap map = traced(LightView::around({0, 0, 0}));
  for (const int level : {2, 4}) {
    RandomStream random(10);
    RunningMoments fine, coarse, difference;
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 p = random_point(random);
      fine.add(map.visibility(p));
      coarse.add(map.visibility(p, level));
      difference.add(std::abs(map.visibility(p) - map.visibility(p, level)));
    }
    EXPECT_NEAR(coarse.mean(), fine.mean(), 0.02) << level;
    EXPECT_GT(difference.mean(), 0.01);  // it does blur
  }
}

TEST(VisibilityMapTest, LevelFollowsTheFootprint) {
  VisibilityMapSettings settings;
  settings.resolution = 64;
  const VisibilityMap map(LightView::around({0, 0, 0}), settings);
  const float texel = map.view().extent() / 64;
  EXPECT_EQ(map.level_of(0), 0);
  EXPECT_EQ(map.level_of(texel), 0);
  EXPECT_EQ(map.level_of(4 * texel), 2);
  EXPECT_EQ(map.level_of(1e9f), map.levels() - 1);
  EXPECT_EQ(map.levels(), 7);
}

TEST(VisibilityMapTest, RowsMayBeTracedInAnyOrder) {
  VisibilityMapSettings settings;
  settings.resolution = 32;
  VisibilityMap a(LightView::around({0, 0, 0}), settings), b = a;
  a.trace_rows(0, 32, trace_plate());
  for (const auto& [begin, end] : {std::pair{20, 32}, {0, 7}, {7, 20}})
    b.trace_rows(begin, end, trace_plate());
  ByteWriter bytes_a, bytes_b;
  a.write(bytes_a);
  b.write(bytes_b);
  EXPECT_EQ(bytes_a.bytes(), bytes_b.bytes());
  EXPECT_GT(bytes_a.bytes().size(), 32 * 32 * 16u);
}

TEST(VisibilityMapTest, SurvivesWritingAndReading) {
  const VisibilityMap map = traced(LightView::cone({0, 0, 0}, {0, 0, 1}, 0.5f), 32);
  ByteWriter out;
  map.write(out);
  ByteReader in(out.bytes());
  const std::optional<VisibilityMap> copy = VisibilityMap::read(in);
  ASSERT_TRUE(copy);
  EXPECT_EQ(in.remaining(), 0u);
  RandomStream random(12);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_point(random);
    EXPECT_EQ(copy->visibility(p), map.visibility(p));
    EXPECT_EQ(copy->visibility(p, 2), map.visibility(p, 2));
  }
  for (const size_t size : {size_t{0}, size_t{3}, size_t{60}, out.bytes().size() - 1}) {
    ByteReader cut(std::span<const std::byte>(out.bytes()).first(size));
    EXPECT_FALSE(VisibilityMap::read(cut));
  }
}

TEST(VisibilityMapTest, UntracedMapsAndBadDistancesAreHarmless) {
  VisibilityMapSettings settings;
  settings.resolution = 8;
  VisibilityMap map(LightView::around({0, 0, 0}), settings);
  EXPECT_EQ(map.visibility({1, 2, 3}), 1);
  EXPECT_EQ(map.visibility({0, 0, 0}), 1);
  map.trace_rows(0, 8, [](const Ray&, Vec2) { return std::nanf(""); });
  map.finish();
  EXPECT_EQ(map.visibility({1, 2, 3}), map.floor());
  EXPECT_GE(map.visibility({1e30f, 1e30f, 0}), map.floor());
  EXPECT_LE(map.memory(), 8 * 8 * 16 * 2u);
}

/// sigma_t = 1 + x^2 along a ray from the origin.
void optical_depth(const Ray& ray, std::span<const float> t, std::span<float> out) {
  for (size_t i = 0; i < t.size(); ++i) out[i] = t[i] * (1 + sqr(ray.d.x * t[i]) / 3);
}

TEST(OpticalDepthMapTest, PredictsTransmittance) {
  // Between 32 steps the curvature 2 r of the depth makes at most 0.013, and 0.003 on
  // average.
  OpticalDepthMap map(LightView::around({0, 0, 0}), 3, 256, 32);
  map.trace_rows(0, map.rows(), optical_depth);
  RandomStream random(11);
  RunningMoments error;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random_point(random);
    const float r = length(p);
    if (r > 3 || r < 0.01f) continue;
    const double depth = r + sqr(p.x / r) * r * r * r / 3;
    const double e = -std::log(static_cast<double>(map.transmittance(p))) - depth;
    error.add(e);
    // The depth changes by up to 9 per radian; half the diagonal of a texel is up to 0.015.
    ASSERT_NEAR(e, 0, 0.15);
  }
  EXPECT_NEAR(error.mean(), 0, 0.005);
}

TEST(OpticalDepthMapTest, IsExactInAHomogeneousMedium) {
  OpticalDepthMap map(LightView::cone({0, 0, 0}, {0, 0, 1}, 0.8f), 10, 4, 8);
  map.trace_rows(0, 4, [](const Ray&, std::span<const float> t, std::span<float> out) {
    std::ranges::transform(t, out.begin(), [](float x) { return 0.7f * x; });
  });
  const Ray ray{{0, 0, 0}, {0, 0, 1}};
  std::vector<float> t, out(100);
  for (int i = 0; i < 100; ++i) t.push_back(0.15f * static_cast<float>(i));
  map.transmittance(ray, t, out);
  for (size_t i = 0; i < t.size(); ++i) {
    const float expected = std::exp(-0.7f * std::min(t[i], 10.0f));
    EXPECT_NEAR(out[i], expected, 1e-5f * expected) << t[i];
    EXPECT_EQ(map.transmittance(ray.at(t[i])), out[i]);
  }
}

}  // namespace
}  // namespace tyndall
