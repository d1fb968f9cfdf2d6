// SPDX-License-Identifier: Apache-2.0
// Light tracing over specular surfaces, against walks that hit the lamp.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "scenes.h"
#include "support/statistical_tests.h"
#include "tyndall/integrators/integrator.h"
#include "tyndall/integrators/particle_pass.h"
#include "tyndall/integrators/particle_tracer.h"

namespace tyndall {
namespace {

constexpr int size = 6;  // of the pictures [pixels]

struct Case {
  std::string lamp, medium, optics;
  std::string integrator = "volpath";
  ScatteringOrders orders = {};
  float lens_radius = 0;
};

Medium medium_of(const std::string& kind) {
  if (kind == "grid") return test::constant_grid(0.35f, 0.05f, 0.4f, 1.2f);
  const Rgb sigma_s = kind == "chromatic" ? Rgb{1.2f, 0.4f, 0} : Rgb(0.35f);
  return Medium(HomogeneousMedium({Rgb(0.05f), sigma_s, Rgb(0)}, HenyeyGreenstein(0.4f)));
}

Surface lamp_of(const std::string& kind) {
  const Vec3 p{0.1f, 0.25f, 0.1f};
  Surface lamp = test::boundary_sphere(0.16f, p, no_medium, no_medium);
  lamp.media = {};
  if (kind == "disk") lamp.shape = Disk{Transform::translate(p), 0, 0.2f, 0, 2 * pi, true};
  lamp.material = DiffuseBsdf{Rgb(0.3f)};
  lamp.emission = AreaEmission{Rgb(9, 7, 5), kind == "disk"};
  return lamp;
}

// A lamp in a hollow of glass, or beside a ball of it, or over a mirror: fog all around, on
// a diffuse floor.
SceneDescription lit_through_glass(const Case& c, Vec2i resolution = {size, size}) {
  SceneDescription d;
  PerspectiveCamera::Settings lens =
      test::camera({-0.3f, 0.2f, -1.1f}, {0.1f, 0, 0}, 75).settings();
  lens.lens_radius = c.lens_radius;
  lens.focal_distance = 1.2f;
  d.camera = PerspectiveCamera(lens, resolution);
  d.media.push_back(medium_of(c.medium));
  d.surfaces.push_back(test::boundary_box(1.2f));
  Surface floor = test::diffuse_disk(0.9f, 3, 0.6f);
  d.surfaces.push_back(floor);
  d.surfaces.push_back(lamp_of(c.lamp));
  if (c.optics == "hollow") {
    Surface inner = test::boundary_sphere(0.3f, {0.1f, 0.25f, 0.1f}, no_medium, no_medium);
    inner.material = DielectricBsdf{1 / 1.5f, 0, 0};
    d.surfaces.push_back(inner);
    Surface outer = test::boundary_sphere(0.45f, {0.1f, 0.25f, 0.1f}, no_medium, 0);
    outer.material = DielectricBsdf{1.5f, 0, 0};
    d.surfaces.push_back(outer);
  } else if (c.optics == "ball") {
    Surface ball = test::boundary_sphere(0.35f, {0.1f, -0.3f, 0.15f}, no_medium, 0);
    ball.material = DielectricBsdf{1.4f, 0, 0};
    d.surfaces.push_back(ball);
  } else {
    Surface mirror = test::boundary_sphere(0.5f, {0.1f, -0.5f, 0.2f}, no_medium, 0);
    mirror.material = ConductorBsdf{Rgb(0.2f, 0.5f, 1), Rgb(3.5f, 2.5f, 2), 0, 0};
    d.surfaces.push_back(mirror);
  }
  return d;
}

Image picture(const Scene& scene, const Case& c, bool particles, uint32_t spp) {
  RenderSettings s = test::settings(c.integrator, 7, c.orders);
  s.resolution = s.crop_max = {size, size};
  s.samples_per_pixel = spp;
  s.options["particles"] = particles ? "on" : "off";
  const RenderResult result = render(scene, s);
  EXPECT_EQ(result.statistics.counters.contains("particles"), particles);
  EXPECT_EQ(result.statistics.rejected.total(), 0);
  return result.film.develop();
}

struct Mean {
  double value = 0, variance = 0;
};

class ParticleTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    All, ParticleTest,
    testing::Values(Case{"disk", "fog", "hollow"}, Case{"sphere", "chromatic", "hollow"},
                    Case{"sphere", "grid", "hollow"}, Case{"sphere", "fog", "ball"},
                    Case{"disk", "chromatic", "ball"}, Case{"disk", "grid", "mirror"},
                    Case{"sphere", "fog", "hollow", "volpath", {2, 3}},
                    Case{"sphere", "fog", "mirror", "volpath", {0, 0}},
                    Case{"sphere", "fog", "ball", "volpath", {}, 0.1f},
                    Case{"sphere", "fog", "hollow", "learned"},
                    Case{"disk", "grid", "mirror", "jis"}));

// Of the pixels of one of four tiles, or of all.
Mean mean_of(const Image& image, const std::string& channel, std::optional<int> tile = {}) {
  Mean mean;
  int pixels = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (tile && *tile != 2 * y / size * 2 + 2 * x / size) continue;
      const auto i = static_cast<size_t>(y * size + x);
      mean.value += double{image.find(channel)->values[i]};
      mean.variance += double{image.find("variance." + channel)->values[i]};
      ++pixels;
    }
  return {mean.value / pixels, mean.variance / (pixels * pixels)};
}

void expect_agreement(const Image& on, const Image& off, int tests) {
  for (const std::string channel : {"R", "G", "B"})
    for (const std::optional<int> tile : {std::optional<int>(), {0}, {1}, {2}, {3}}) {
      const Mean a = mean_of(on, channel, tile), b = mean_of(off, channel, tile);
      const double error = std::sqrt(a.variance + b.variance);
      EXPECT_GT(z_p_value(a.value, error, b.value), sidak(0.01, 15 * tests))
          << channel << ": " << a.value << " instead of " << b.value << ", error " << error;
      EXPECT_LT(error, (tile ? 0.15 : 0.07) * b.value);
    }
}

// The same picture, in all and by tiles, and with less variance in the same samples.
TEST_P(ParticleTest, AgreesWithWalks) {
  const Scene scene(lit_through_glass(GetParam()));
  const bool learns = GetParam().integrator != "volpath";
  const Image on = picture(scene, GetParam(), true, learns ? 1000 : 4000);
  const Image off = picture(scene, GetParam(), false, learns ? 2500 : 16000);
  expect_agreement(on, off, 11);
}

// A point light, that no walk can hit, and a small lamp of the same power, that walks do.
class PointLightTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Optics, PointLightTest,
                         testing::Values("hollow", "ball", "mirror"));

TEST_P(PointLightTest, ShinesAsASmallSphere) {
  const Case c{"sphere", "fog", GetParam()};
  SceneDescription d = lit_through_glass(c);
  // From outside the fog: what is found next to the camera is rare and bright.
  d.camera = test::camera({-0.3f, 0.2f, -3.5f}, {0.1f, 0, 0}, 45, {size, size});
  constexpr float radius = 0.05f;
  Surface& lamp = d.surfaces[2];
  lamp.shape = test::boundary_sphere(radius, {0.1f, 0.25f, 0.1f}).shape;
  lamp.material = DiffuseBsdf{Rgb(0)};
  SceneDescription point = d;
  point.surfaces.erase(point.surfaces.begin() + 2);
  const Rgb I = lamp.emission->L * (pi * sqr(radius));
  point.lights.push_back(Light(PointLight{{0.1f, 0.25f, 0.1f}, I}));
  // Not what sees the lamp itself.
  const ScatteringOrders scattered{1, 20};
  const Image off = picture(Scene(d), {"", "", "", "volpath", scattered}, false, 60000);
  // Connections find what is next to the light; to walks it is rare and bright.
  const Image on = picture(Scene(point), {"", "", "", "jis", scattered}, true, 6000);
  expect_agreement(on, off, 3);
}

// A wall that glows, around glass in white fog: everything is as bright as the wall.
TEST(Particles, WhiteFurnaceStaysWhite) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -1.2f}, {0, 0, 0}, 60, {100, 100});
  d.media.push_back(test::grey_fog(1, 0, 0.5f));
  Surface wall = test::boundary_sphere(2, {}, 0, 0);
  std::get<Sphere>(wall.shape).flip_normals = true;
  wall.material = DiffuseBsdf{Rgb(0)};
  wall.emission = AreaEmission{Rgb(1), false};
  d.surfaces.push_back(wall);
  Surface ball = test::boundary_sphere(0.6f, {}, no_medium, 0);
  ball.material = DielectricBsdf{1.5f, 0, 0};
  d.surfaces.push_back(ball);
  RenderSettings s = test::settings("volpath", 1000);
  s.resolution = s.crop_max = {100, 100};
  s.samples_per_pixel = 4;  // before they are given up: nothing is gained here
  const Scene scene(d);
  const RenderResult result = render(scene, s);
  EXPECT_GT(result.statistics.counters.at("particles"), 0);
  const Image image = result.film.develop();
  RunningMoments mean;  // of pixels
  for (const float value : image.find("G")->values) mean.add(double{value});
  EXPECT_GT(z_p_value(mean, 1), 0.01);
  EXPECT_LT(mean.standard_error(), 0.02);
}

// What the particles of a first sample bring to the picture in so many seconds. If that is
// nothing, because other programs hold up the threads, there is a little more time.
double first_splats(const Scene& scene, uint64_t seed, double seconds) {
  RenderSettings s = test::settings("volpath", 7);
  s.resolution = s.crop_max = {300, 300};
  s.seed = seed;
  ParticleTracer tracer(scene, s, {.max_depth = 7, .orders = {}, .is_chromatic = false});
  const Filter filter(s.filter);
  ParticlePass pass(filter, s);
  double sum = 0;
  do {
    Film film(s.resolution, s.crop_min, s.crop_max);
    pass.run(tracer, 0, film, Deadline::in(seconds));
    for (int i = 0; i < 300 * 300; ++i) sum += film.estimate({i % 300, i / 300}).mean[1];
    seconds *= 2;
  } while (sum == 0 && seconds < 0.1);
  return sum;
}

// As many particles as there is time for stand for all.
TEST(Particles, ThoseBeforeTheDeadlineStandForAll) {
  const Scene scene(lit_through_glass({"sphere", "fog", "hollow"}, {300, 300}));
  RunningMoments all, some;
  for (uint64_t seed = 0; seed < 8; ++seed) all.add(first_splats(scene, seed, 1e6));
  for (uint64_t seed = 100; seed < 150; ++seed) some.add(first_splats(scene, seed, 0.004));
  const double error = std::hypot(all.standard_error(), some.standard_error());
  EXPECT_GT(z_p_value(some.mean(), error, all.mean()), 0.01);
  EXPECT_LT(error, 0.05 * all.mean());
}

// Those of later samples are dropped instead.
TEST(Particles, ThoseOfLaterSamplesAreAllOrNone) {
  const Scene scene(lit_through_glass({"sphere", "fog", "hollow"}, {300, 300}));
  RenderSettings s = test::settings("volpath", 7);
  s.resolution = s.crop_max = {300, 300};
  const ParticleTracer tracer(scene, s,
                              {.max_depth = 7, .orders = {}, .is_chromatic = false});
  const Filter filter(s.filter);
  ParticlePass pass(filter, s);
  Film film(s.resolution, s.crop_min, s.crop_max), same(film);
  pass.run(tracer, 0, film, {});
  const Image before = film.develop();
  pass.run(tracer, 1, film, Deadline::in(0.002));
  EXPECT_EQ(before.find("G")->values, film.develop().find("G")->values);
  // Nor do they count to what comes after.
  pass.run(tracer, 1, film, {});
  pass.run(tracer, 0, same, {});
  pass.run(tracer, 1, same, {});
  EXPECT_EQ(same.develop().find("G")->values, film.develop().find("G")->values);
}

// The red, of which there is most, that the particles of one sample bring to the picture,
// with `maximum` for the largest component of a splat.
double red_splats(const Scene& scene, float maximum) {
  RenderSettings s = test::settings("volpath", 7);
  s.resolution = s.crop_max = {60, 60};
  s.imaging_ratio = 4;
  s.max_component = maximum;
  const ParticleTracer tracer(scene, s,
                              {.max_depth = 7, .orders = {}, .is_chromatic = false});
  const Filter filter(s.filter);
  Film film(s.resolution, s.crop_min, s.crop_max);
  ParticlePass(filter, s).run(tracer, 0, film, {});
  double sum = 0;
  for (int i = 0; i < 60 * 60; ++i) sum += film.estimate({i % 60, i / 60}).mean[0];
  return sum;
}

// As pbrt-v4's film: after the imaging ratio, before the filter, by the largest component.
TEST(Particles, SplatsAreDimmedToTheMaximumComponent) {
  const Scene scene(lit_through_glass({"sphere", "fog", "hollow"}, {60, 60}));
  const double all = red_splats(scene, infinity);
  EXPECT_EQ(red_splats(scene, 1e6f), all);
  EXPECT_GT(red_splats(scene, 0.5f), 0.1 * all);
  EXPECT_LT(red_splats(scene, 0.5f), 0.9 * all);
  // So little that all are dimmed. There is a particle for each pixel, with a splat for
  // each of its vertices but the first.
  const double few = red_splats(scene, 1e-12f);
  EXPECT_NEAR(red_splats(scene, 2e-12f), 2 * few, 1e-5 * few);
  EXPECT_GT(few, 0);
  EXPECT_LT(few, 6 * 1e-12 * 60 * 60);
}

// Not pilot paths, nor those that connections are compared with.
TEST(Particles, AreWeighedAgainstTheWalksOfThePicture) {
  const Scene scene(lit_through_glass({"sphere", "fog", "hollow"}));
  const RenderSettings s = test::settings("equiangular", 7);
  const std::unique_ptr<Integrator> integrator = make_integrator(scene, s);
  const ParticleTracer* particles = integrator->particles();
  ASSERT_TRUE(particles);
  for (const uint32_t first : {0u, 1u, 4u}) integrator->prepare(first, {});
  EXPECT_EQ(particles->walk_rays(), 0);
  Sampler sampler(s.sampler, s.seed, {0, 0}, 0);
  integrator->Li(scene.camera().ray({0.5f, 0.5f}, {0.5f, 0.5f}), sampler);
  EXPECT_GE(particles->walk_rays(), 2);
}

Image picture_of_30(const std::string& integrator, int threads, uint32_t spp) {
  const Case c{"sphere", "chromatic", "ball"};
  static const Scene scene(lit_through_glass(c));
  RenderSettings s = test::settings(integrator, 7);
  s.sampler = SamplerKind::sobol;
  s.resolution = s.crop_max = {30, 20};
  s.samples_per_pixel = spp;
  RenderOptions options;
  options.threads = threads;
  return render(scene, s, options).film.develop();
}

class ParticlesTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, ParticlesTest, testing::ValuesIn(integrator_names()));

TEST_P(ParticlesTest, SameImageForAnyNumberOfThreads) {
  const Image one = picture_of_30(GetParam(), 1, 9);
  for (const int threads : {2, 7}) {
    const Image other = picture_of_30(GetParam(), threads, 9);
    for (size_t i = 0; i < one.channels().size(); ++i)
      EXPECT_EQ(one.channels()[i].values, other.channels()[i].values);
  }
}

// What is stopped after some samples is the picture of so many.
TEST_P(ParticlesTest, PassesDoNotMatter) {
  const Scene scene(lit_through_glass({"disk", "fog", "ball"}));
  RenderSettings s = test::settings(GetParam(), 7);
  s.resolution = s.crop_max = {30, 20};
  s.samples_per_pixel = 20;
  std::map<uint32_t, Image> pictures;
  RenderOptions options;
  options.on_pass = [&](const Film& film, uint32_t samples) {
    pictures.emplace(samples, film.develop());
  };
  render(scene, s, options);
  ASSERT_GT(pictures.size(), 2u);
  for (const auto& [samples, picture] : pictures) {
    s.samples_per_pixel = samples;
    const Image whole = render(scene, s).film.develop();
    for (size_t i = 0; i < whole.channels().size(); ++i)
      EXPECT_EQ(whole.channels()[i].values, picture.channels()[i].values) << samples;
  }
}

TEST(Particles, CropShowsPartOfThePicture) {
  const Scene scene(lit_through_glass({"sphere", "fog", "ball"}));
  RenderSettings s = test::settings("volpath", 7);
  s.resolution = s.crop_max = {12, 12};
  s.samples_per_pixel = 2000;
  const Image full = render(scene, s).film.develop();
  s.crop_min = {3, 5};
  s.crop_max = {9, 8};
  const Image crop = render(scene, s).film.develop();
  Mean in_full, in_crop;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 6; ++x) {
      const auto i = static_cast<size_t>((y + 5) * 12 + x + 3);
      const auto j = static_cast<size_t>(y * 6 + x);
      in_full.value += double{full.find("G")->values[i]};
      in_full.variance += double{full.find("variance.G")->values[i]};
      in_crop.value += double{crop.find("G")->values[j]};
      in_crop.variance += double{crop.find("variance.G")->values[j]};
    }
  const double error = std::sqrt(in_full.variance + in_crop.variance);
  EXPECT_GT(z_p_value(in_crop.value, error, in_full.value), 0.01);
  EXPECT_LT(error, 0.07 * in_full.value);
}

// Without anything specular, or where only a sky shines, there are none.
TEST(Particles, AreTracedWhereLampsReachSpecularSurfacesOnly) {
  const auto traced = [](const SceneDescription& d) {
    RenderSettings s = test::settings("volpath", 7);
    s.resolution = s.crop_max = {2, 2};
    s.samples_per_pixel = 1;
    return render(Scene(d), s).statistics.counters.contains("particles");
  };
  SceneDescription d = lit_through_glass({"sphere", "fog", "ball"});
  EXPECT_TRUE(traced(d));
  SceneDescription rough = d;
  rough.surfaces.back().material = DielectricBsdf{1.4f, 0.1f, 0.1f};
  EXPECT_FALSE(traced(rough));
  SceneDescription hidden = d;
  Surface shade = test::boundary_sphere(0.2f, {0.1f, 0.25f, 0.1f}, 0, 0);
  shade.material = DiffuseBsdf{Rgb(0.5f)};
  hidden.surfaces.push_back(shade);
  EXPECT_FALSE(traced(hidden));
  d.surfaces[2].emission.reset();
  d.lights.push_back(Light(ConstantEnvironment{Rgb(1)}));
  EXPECT_FALSE(traced(d));
}

}  // namespace
}  // namespace tyndall
