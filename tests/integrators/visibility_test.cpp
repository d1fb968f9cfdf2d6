// SPDX-License-Identifier: Apache-2.0
// Predicted visibility: what is sampled with it, and that a wrong one biases nothing.
#include <gtest/gtest.h>

#include <array>

#include "scenes.h"
#include "support/chi_square.h"
#include "tyndall/integrators/connection_leg.h"
#include "tyndall/integrators/light_visibility.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

// Fog around a point light and a disk that shades half of what the camera sees.
SceneDescription shaded_fog(Light light = Light(PointLight{{0, 2, 0}, Rgb(10)})) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -3}, {0, 0, 0});
  d.camera_medium = 0;
  d.media.push_back(test::grey_fog(0.25f, 0.05f, 0.4f));
  d.surfaces.push_back(test::diffuse_disk(4, 50, 0.3f));
  Surface shade = test::diffuse_disk(1, 0.8f, 0.1f);
  auto& disk = std::get<Disk>(shade.shape);
  disk.world_from_disk =
      Transform::translate({0.5f, 0.2f, 0}) * Transform::rotate(-90, {1, 0, 0});
  d.surfaces.push_back(shade);
  d.lights.push_back(std::move(light));
  return d;
}

// A map of light 0 whose distances are made from the right ones.
std::shared_ptr<const LightVisibility> changed_map(const Scene& scene,
                                                   float (*change)(float)) {
  const LightVisibility visibility(scene);
  const VisibilityMap& right = *visibility.maps().at(0);
  VisibilityMapSettings settings;
  settings.resolution = right.rows();
  settings.floor = right.floor();
  auto map = std::make_shared<VisibilityMap>(right.view(), settings);
  const auto side = static_cast<float>(right.rows());
  int row = 0, ray = 0;
  for (; row < right.rows(); ++row) {
    ray = 0;
    map->trace_rows(row, row + 1, [&](const Ray&, Vec2) {
      const int x = ray / 4, quantile = ray++ % 4;
      EXPECT_LT(static_cast<float>(x), side);
      return change(right.distances(x, row)[static_cast<size_t>(quantile)]);
    });
  }
  map->finish();
  return std::make_shared<const LightVisibility>(LightVisibility::Maps{{0, map}});
}

RunningMoments radiance(const Scene& scene, const ConnectionSettings& connections,
                        uint64_t seed, int count) {
  return test::estimate(scene, connections, seed, count, {0, 0, -3}, 2);
}

TEST(PredictedVisibilityTest, AWrongMapIsNoBias) {
  const Scene scene(shaded_fog());
  const RunningMoments path = radiance(scene, {}, 1, 150'000);
  const auto dark = changed_map(scene, [](float) { return 0.0f; });
  const auto inverted =
      changed_map(scene, [](float distance) { return distance < 2 ? infinity : 0.0f; });
  uint64_t seed = 2;
  double right_variance = 0;
  const auto right = std::make_shared<const LightVisibility>(scene);
  for (const auto& maps : {right, dark, inverted}) {
    const RunningMoments guided =
        radiance(scene, test::with_visibility(maps), seed++, 120'000);
    EXPECT_LT(guided.standard_error(), 0.02 * guided.mean());
    EXPECT_GT(welch_p_value(path, guided), 1e-3)
        << seed << ": " << path.mean() << " +- " << path.standard_error() << " vs "
        << guided.mean() << " +- " << guided.standard_error();
    if (maps == right) right_variance = guided.variance();
    // The maps do guide: wrong ones cost variance.
    if (maps == inverted) {
      EXPECT_GT(guided.variance(), right_variance);
    }
  }
}

// A pair of taps is mixed with those beside it: what lies just behind an edge is not dark.
TEST(PredictedVisibilityTest, BinsKnowOfTheirNeighbours) {
  VisibilityMapSettings settings;
  settings.resolution = 256;
  auto map = std::make_shared<VisibilityMap>(LightView::around({}), settings);
  map->trace_rows(0, map->rows(),
                  [](const Ray& ray, Vec2) { return ray.d.x < 0 ? infinity : 0.0f; });
  map->finish();
  const LightVisibility visibility(LightVisibility::Maps{{0, map}});
  std::array<float, 32> t;
  for (size_t i = 0; i < t.size(); ++i) t[i] = (static_cast<float>(i) + 0.5f) / 16;
  std::array<float, 16> weights;
  weights.fill(2);
  visibility.multiply(0, Ray{{-1, 0, 1}, {1, 0, 0}}, t, 0, weights);  // lit up to t = 1
  const float dark = map->floor();
  for (const size_t i : {0, 3, 6}) EXPECT_FLOAT_EQ(weights[i], 2);
  EXPECT_FLOAT_EQ(weights[7], 2 * (0.75f + 0.25f * dark));
  EXPECT_FLOAT_EQ(weights[8], 2 * (0.25f + 0.75f * dark));
  for (const size_t i : {9, 12, 15}) EXPECT_FLOAT_EQ(weights[i], 2 * dark);
}

// What a leg samples with predicted visibility has the density that it states, and follows
// the shadow.
TEST(PredictedVisibilityTest, DistancesHaveTheirDensity) {
  const Scene scene(shaded_fog());
  const ConnectionContext context(scene, test::with_visibility({}));
  const Pivots pivots(scene, 1);
  for (const Vec3 d : {Vec3{0.2f, 0, 1}, Vec3{0, 0.1f, 1}, Vec3{0.5f, -0.2f, 1}}) {
    const Ray ray{{0, 0, -3}, normalize(d)};
    Leg leg(scene, ray, scene.camera_medium());
    ConnectionLeg connection(context, pivots, leg);
    const ConnectionLeg::Single* single = connection.single(0);
    ASSERT_TRUE(single);
    // In the coordinate of the base technique the density is constant over each bin.
    const EquiangularSampling& base = single->base();
    const auto pdf_x = [&](double x) {
      const std::optional<DistanceSample> at = base.sample(static_cast<float>(x));
      return at ? double{single->pdf_t(at->t)} / double{at->pdf_t} : 0;
    };
    const ChiSquareResult r = chi_square_line(
        [&](float u) -> std::optional<float> {
          const std::optional<DistanceSample> s = single->sample(u);
          return s ? std::optional<float>(base.invert(s->t)) : std::nullopt;
        },
        pdf_x, 0, 1);
    EXPECT_GT(r.p_value, sidak(0.01, 3)) << r;
    EXPECT_NEAR(r.mass, 1, 1e-4);
    EXPECT_EQ(r.samples_of_zero_pdf, 0);
    double mean = 0;
    constexpr int bins = 64;
    for (int i = 0; i < bins; ++i)
      mean += pdf_x((i + 0.5) / bins) * (i + 0.5) / bins / bins;
    EXPECT_GT(z_p_value(r.moments[0], mean), 1e-3);
  }
}

double lit_share(const Scene& scene, const ConnectionSettings& settings) {
  const ConnectionContext context(scene, settings);
  RunningMoments lit;
  RandomStream random(5);
  for (uint64_t i = 0; i < 4000; ++i) {
    const Pivots pivots(scene, i);
    const Ray ray{{0, 0, -3}, normalize(Vec3{0.6f * random.next_1d(), -0.1f, 2})};
    Leg leg(scene, ray, scene.camera_medium());
    ConnectionLeg connection(context, pivots, leg);
    const ConnectionLeg::Single* single = connection.single(0);
    const auto s = single ? single->sample(random.next_1d()) : std::nullopt;
    if (!s) continue;
    const Vec3 p = ray.at(s->t), to_light = *connection.pivot(0) - p;
    const float distance = length(to_light);
    lit.add(scene.is_occluded({p, to_light / distance}, distance * 0.999f) ? 0 : 1);
  }
  return lit.mean();
}

// Near and far, point and area: nine of ten samples land where the light shines, which
// without maps half of them miss.
TEST(PredictedVisibilityTest, SamplesLandInTheLight) {
  const Shape sphere = Sphere{.world_from_sphere = Transform::translate({0, 60, 0}),
                              .radius = 1,
                              .z_min = -1,
                              .z_max = 1,
                              .phi_max = 2 * pi,
                              .flip_normals = false};
  for (const Light& light :
       {Light(PointLight{{0, 2, 0}, Rgb(10)}), Light(PointLight{{3, 60, 0}, Rgb(10)}),
        Light(AreaLight{.shape = &sphere, .L = Rgb(1), .two_sided = false})}) {
    const Scene scene(shaded_fog(light));
    EXPECT_GT(lit_share(scene, test::with_visibility({})), 0.9);
    EXPECT_LT(lit_share(scene, {.single = true, .min_distance_ratio = 1}), 0.85);
  }
}

// A ball of smoke around or beside a light: what is left of its light at points inside.
TEST(PredictedVisibilityTest, LightIsDimmedByTheSmokeOnItsWay) {
  for (const Vec3 light : {Vec3{0, 0, 0}, Vec3{0, 3, 0}}) {
    SceneDescription d;
    d.camera = test::camera({0, 0, -3}, {0, 0, 0});
    d.media.push_back(test::constant_grid(1, 0.5f, 0, 1.3f));
    d.surfaces.push_back(test::boundary_sphere(1));
    d.lights.push_back(Light(PointLight{light, Rgb(1)}));
    const Scene scene(std::move(d));
    const LightVisibility visibility(scene);
    RandomStream random(3);
    for (int i = 0; i < 200; ++i) {
      const Vec3 w = sample_uniform_sphere(random.next_2d());
      const Vec3 p = w * (0.2f + 0.7f * random.next_1d());
      float weight = 2;
      const float t = 1;
      const Ray ray{p - Vec3{0, 0, 1}, {0, 0, 1}};
      visibility.multiply_transmittance(0, ray, {&t, 1}, {&weight, 1});
      // From p towards the light, up to the ball's border or the light itself.
      const float distance = length(light - p), b = dot(p, (light - p) / distance);
      const float to_border = -b + std::sqrt(b * b + 1 - dot(p, p));
      const float inside = std::min(distance, to_border);
      EXPECT_NEAR(weight, 2 * std::exp(-1.5f * inside), 0.1f) << p.x << ' ' << p.y;
    }
  }
}

}  // namespace
}  // namespace tyndall
