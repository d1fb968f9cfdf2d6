// SPDX-License-Identifier: Apache-2.0
// Learned directions in whole renders: unbiased whatever was learned, and never from the
// pass in hand.
#include "tyndall/integrators/direction_guiding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"
#include "support/statistical_tests.h"
#include "tyndall/integrators/path_tracer.h"

namespace tyndall {
namespace {

// A lamp over a disk in fog: most of the picture sees no direct light.
SceneDescription lamp_over_disk(float scale = 1) {
  SceneDescription d;
  d.camera = test::camera(Vec3{0, 0, -3} * scale, {0, 0, 0}, 40, {16, 16});
  d.camera_medium = 0;
  d.media.push_back(test::grey_fog(0.4f / scale, 0.1f / scale, 0.5f));
  d.surfaces.push_back(test::diffuse_disk(0, 1 * scale, 0.5f));
  d.lights.push_back(
      Light(PointLight{Vec3{0.3f, 0.2f, 1} * scale, Rgb(5 * scale * scale)}));
  return d;
}

RenderSettings order_two(uint32_t samples, const std::string& integrator = "zhou2016") {
  RenderSettings s = test::settings(integrator, 2, {2, 2});
  s.resolution = s.crop_max = {16, 16};
  s.samples_per_pixel = samples;
  return s;
}

// Mean over the picture of `count` samples of each pixel.
RunningMoments mean_of(const Scene& scene, const Integrator& integrator, uint32_t first,
                       uint32_t count, uint64_t seed) {
  RunningMoments moments;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (uint32_t i = first; i < first + count; ++i) {
        Sampler sampler(SamplerKind::independent, seed, {x, y}, i);
        const Vec2 u = sampler.next_2d();
        const Ray ray = scene.camera().ray(
            {static_cast<float>(x) + u.x, static_cast<float>(y) + u.y}, {0.5f, 0.5f});
        moments.add(integrator.Li(ray, sampler).L.g);
      }
  return moments;
}

// What a liar would teach: that all light comes from the wrong side.
std::shared_ptr<const RecordCache> lies(const Scene& scene) {
  RecordCacheSettings settings;
  settings.training.shares.floor = 0.05f;
  auto cache = std::make_shared<RecordCache>(std::vector<LightCluster>{{}}, settings);
  TrainingBuffer buffer;
  const Vec3 light = std::get<PointLight>(scene.lights()[0].variant()).p;
  for (int pass = 0; pass < 3; ++pass) {
    buffer.clear();
    for (uint64_t key = 0; key < 4000; ++key) {
      RandomStream random(hash(key, pass));
      TrainingSample s;
      s.key = key;
      s.p =
          (Vec3{random.next_1d(), random.next_1d(), random.next_1d()} * 2 - Vec3{1, 1, 1}) *
          3;
      s.light_distance = distance(light, s.p);
      s.light_direction = (light - s.p) / s.light_distance;
      const Vec3 wrong = normalize(Vec3{1, 0.2f, -0.3f});
      s.wi = normalize(wrong +
                       Vec3{random.next_1d(), random.next_1d(), random.next_1d()} * 0.1f);
      s.weight = s.pdf = s.mixture_pdf = 1;
      s.joint_pdf = s.phase_pdf = 1e-3f;
      buffer.push_back(s);
    }
    cache->update({&buffer, 1});
  }
  return cache;
}

TEST(DirectionGuidingTest, ThePassInHandTeachesNothingYet) {
  const Scene scene(lamp_over_disk());
  const auto integrator = make_integrator(scene, order_two(8));
  ASSERT_EQ(integrator->prepare(0, {}), 1u);
  mean_of(scene, *integrator, 0, 1, 1);
  ASSERT_EQ(integrator->prepare(1, {}), 2u);
  const RunningMoments before = mean_of(scene, *integrator, 1, 1, 1);
  mean_of(scene, *integrator, 0, 20, 2);  // others, in the same pass
  const RunningMoments after = mean_of(scene, *integrator, 1, 1, 1);
  EXPECT_EQ(before.mean(), after.mean());
  EXPECT_EQ(before.variance(), after.variance());
  // They would have: the next pass is different.
  integrator->prepare(2, {});
  EXPECT_NE(mean_of(scene, *integrator, 1, 1, 1).mean(), before.mean());
}

void expect_lies_cost_variance_only(const Scene& scene,
                                    const RenderSettings& render_settings) {
  ConnectionSettings settings = connection_settings("zhou2016", {});
  const PathTracer honest(scene, render_settings, settings);
  settings.known_directions = lies(scene);
  PathTracer misled(scene, render_settings, settings);
  EXPECT_EQ(misled.prepare(0, {}), 1u);
  RenderSettings plain = render_settings;
  plain.integrator = "volpath";
  const auto volpath = make_integrator(scene, plain);
  const RunningMoments reference = mean_of(scene, *volpath, 0, 4000, 1);
  const RunningMoments a = mean_of(scene, honest, 0, 400, 2);
  const RunningMoments b = mean_of(scene, misled, 0, 400, 3);
  EXPECT_GT(welch_p_value(reference, a), sidak(0.01, 3));
  EXPECT_GT(welch_p_value(reference, b), sidak(0.01, 3));
  EXPECT_GT(welch_p_value(a, b), sidak(0.01, 3));
  // The lies were believed.
  EXPECT_GT(b.variance(), 1.3 * a.variance());
}

TEST(DirectionGuidingTest, LiesCostVarianceOnly) {
  const Scene scene(lamp_over_disk());
  expect_lies_cost_variance_only(scene, order_two(1));
}

// A ball of smoke around a lamp lights a disk in clear air, which fills the picture.
TEST(DirectionGuidingTest, LiesToSurfacesCostVarianceOnly) {
  SceneDescription d;
  d.camera = test::camera({0, 0, 1.2f}, {0, 0, 0}, 40, {16, 16});
  d.media.push_back(test::grey_fog(0.8f, 0.1f, 0.5f));
  d.surfaces.push_back(test::diffuse_disk(0, 3, 0.5f));
  d.surfaces.push_back(test::boundary_sphere(0.5f, {0.3f, 0.2f, 2}));
  d.lights.push_back(Light(PointLight{{0.3f, 0.2f, 2}, Rgb(5)}));
  const Scene scene(std::move(d));
  RenderSettings settings = order_two(1);
  settings.orders = {1, 1};
  expect_lies_cost_variance_only(scene, settings);
}

RenderStatistics statistics_of(SceneDescription description,
                               std::map<std::string, std::string> options = {}) {
  const Scene scene(std::move(description));
  RenderSettings settings = order_two(8);
  settings.options = std::move(options);
  const RenderResult result = render(scene, settings);
  EXPECT_EQ(result.statistics.rejected.total(), 0);
  return result.statistics;
}

TEST(DirectionGuidingTest, LearnsAndReports) {
  const RenderStatistics s = statistics_of(lamp_over_disk());
  EXPECT_GE(s.counters.at("guiding.records"), 1);
  EXPECT_GE(s.counters.at("guiding.guides.trained"), 1);
  EXPECT_GT(s.counters.at("guiding.samples"), 500);
  EXPECT_EQ(s.counters.at("guiding.samples.rejected"), 0);
  EXPECT_GT(s.counters.at("guiding.memory_bytes"), 0);
  EXPECT_LT(s.counters.at("guiding.memory_bytes"), 256 << 20);
}

TEST(DirectionGuidingTest, StaysBelowTheMemoryThatItIsGiven) {
  const double roomy = statistics_of(lamp_over_disk()).counters.at("guiding.memory_bytes");
  EXPECT_GT(roomy, 3e5);  // else this tests nothing
  for (const char* memory : {"0.3", "0.05", "1e-6"}) {
    const RenderStatistics s =
        statistics_of(lamp_over_disk(), {{"learned.memory", memory}});
    // What the one record takes that there always is.
    const double least = 2000;
    EXPECT_LE(s.counters.at("guiding.memory_bytes"),
              std::max(1e6 * std::stod(memory), least));
  }
}

// What is learned in 64 samples of a pixel is no bias of `count` others.
void expect_no_bias(const Scene& scene, const ConnectionSettings& settings,
                    uint32_t count) {
  PathTracer guided(scene, order_two(1), settings);
  for (uint32_t first = 0, next = 0; first < 64; first = next) {
    next = guided.prepare(first, {});
    mean_of(scene, guided, first, next - first, 1);
  }
  guided.prepare(64, {});
  const RunningMoments learned = mean_of(scene, guided, 64, count, 2);
  const auto volpath = make_integrator(scene, order_two(1, "volpath"));
  const RunningMoments reference = mean_of(scene, *volpath, 0, 4000, 1);
  EXPECT_GT(welch_p_value(reference, learned), 0.005);
}

TEST(DirectionGuidingTest, LittleMemoryIsNoBias) {
  expect_no_bias(Scene(lamp_over_disk()),
                 connection_settings("zhou2016", {{"learned.memory", "0.1"}}), 400);
}

// Six lamps around, of which black spheres hide all but the first.
SceneDescription lamps_in_boxes() {
  SceneDescription d = lamp_over_disk();
  for (int i = 0; i < 5; ++i) {
    const float angle = 1.2f * static_cast<float>(i);
    const Vec3 p{1.5f * std::cos(angle), 1.5f * std::sin(angle), 0.5f};
    d.lights.push_back(Light(PointLight{p, Rgb(5)}));
    d.surfaces.push_back(test::boundary_sphere(0.05f, p, 0, 0));
    d.surfaces.back().material = DiffuseBsdf{Rgb(0)};
  }
  return d;
}

// Samples around the middle of the scene that found light of lamp 0 only.
TEST(DirectionGuidingTest, LearnsWhichLightsContribute) {
  const Scene scene(lamps_in_boxes());
  DirectionGuiding guiding(scene, connection_settings("zhou2016", {}));
  guiding.prepare(0);
  for (uint64_t key = 0; key < 6000; ++key) {
    RandomStream random(hash(key));
    TrainingSample s;
    s.key = key;
    const float x = random.next_1d(), y = random.next_1d(), z = random.next_1d();
    s.p = {x - 0.5f, y - 0.5f, z - 0.5f};
    const auto light = static_cast<size_t>(key % 6);
    const Vec3 to_light = std::get<PointLight>(scene.lights()[light].variant()).p - s.p;
    s.light_distance = length(to_light);
    s.light_direction = to_light / s.light_distance;
    s.wi = s.light_direction;
    s.weight = light == 0 ? 1 : 0;
    s.pdf = s.mixture_pdf = s.joint_pdf = s.phase_pdf = 1;
    s.cluster = guiding.cluster_of(light);
    ASSERT_TRUE(guiding.wants(key));
    guiding.record(s);
  }
  guiding.prepare(1);
  const LightChoice choice(scene.lights(), scene.bounds());
  const Vec3 p{0.1f, 0, 0.1f};
  const LightProbabilities blind = choice.at_point(p), wise = guiding.choose(blind, p);
  EXPECT_GT(wise.probability(0), 0.5f);
  float sum = 0;
  for (size_t i = 0; i < 6; ++i) {
    sum += wise.probability(i);
    // Half of the choice stays as it was.
    EXPECT_GT(wise.probability(i), 0.49f * blind.probability(i));
  }
  EXPECT_NEAR(sum, 1, 1e-5f);
  // Where nothing was learned, nothing changes.
  EXPECT_EQ(guiding.choose(blind, {50, 0, 0}).probability(3), blind.probability(3));
}

TEST(DirectionGuidingTest, LightsThatAreChosenByWhatTheyContributedAreNoBias) {
  expect_no_bias(Scene(lamps_in_boxes()), connection_settings("zhou2016", {}), 600);
}

TEST(DirectionGuidingTest, AllLightsHiddenTeachNothing) {
  SceneDescription d = lamp_over_disk();
  d.surfaces.push_back(test::boundary_sphere(0.2f, {0.3f, 0.2f, 1}, 0, 0));
  d.surfaces.back().material = DiffuseBsdf{Rgb(0)};
  statistics_of(d);  // pre-training does not know that it is in vain
  const RenderStatistics s = statistics_of(d, {{"learned.pretraining", "off"}});
  EXPECT_EQ(s.counters.at("guiding.guides.trained"), 0);
  EXPECT_EQ(s.notes,
            std::vector<std::string>{"no directions were learned: no light arrived after "
                                     "two scattering events, or too few samples were "
                                     "taken"});
}

TEST(DirectionGuidingTest, SaysWhatLearningDirectionsTakes) {
  RenderSettings settings = order_two(8);
  settings.max_depth = 1;
  EXPECT_EQ(render(Scene(lamp_over_disk()), settings).statistics.notes,
            std::vector<std::string>{"no directions were learned: they are those between "
                                     "two scattering events, and at most 1 is allowed"});
}

TEST(DirectionGuidingTest, LightsOutOfTheSceneAndHugeScenesAreNoTrouble) {
  SceneDescription d = lamp_over_disk();
  d.lights.push_back(Light(PointLight{{1e4f, 0, 0}, Rgb(1e4f)}));
  statistics_of(std::move(d));
  EXPECT_GE(statistics_of(lamp_over_disk(1e6f)).counters.at("guiding.guides.trained"), 1);
}

TEST(DirectionGuidingTest, NoMediumMeansNothingToLearn) {
  SceneDescription d = lamp_over_disk();
  d.camera_medium = no_medium;
  EXPECT_FALSE(statistics_of(std::move(d)).counters.contains("guiding.samples"));
}

}  // namespace
}  // namespace tyndall
