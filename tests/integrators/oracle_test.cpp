// SPDX-License-Identifier: Apache-2.0
// Every integrator against closed forms.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "scenes.h"
#include "support/statistical_tests.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

using test::estimate;

// The number of samples against closed forms: TYNDALL_ORACLE_SAMPLES, or the usual one.
int sample_count(int usual) {
  const char* text = std::getenv("TYNDALL_ORACLE_SAMPLES");
  return text ? static_cast<int>(std::atof(text)) : usual;  // 1e7 is a number
}

// Shows how far off an estimate is, to those who asked for more samples.
void show(const RunningMoments& estimate, double expected) {
  if (!std::getenv("TYNDALL_ORACLE_SAMPLES")) return;
  std::cout << estimate.count() << " samples: mean " << estimate.mean() << ", expected "
            << expected << ", standard error " << 100 * estimate.standard_error() / expected
            << " %, off by " << (estimate.mean() - expected) / estimate.standard_error()
            << " of it\n";
}

class OracleTest : public testing::TestWithParam<std::string> {
 protected:
  // The estimate agrees with `expected`, and is precise enough for that to mean something.
  static void expect_mean(const RunningMoments& estimate, double expected,
                          double precision) {
    show(estimate, expected);
    EXPECT_LT(estimate.standard_error(), precision * expected);
    // Where there is no variance, there is still the rounding of floats.
    const double error = std::hypot(estimate.standard_error(), 1e-6 * expected);
    EXPECT_GT(z_p_value(estimate.mean(), error, expected), 1e-4)
        << "mean " << estimate.mean() << " +- " << estimate.standard_error()
        << ", expected " << expected;
  }
};

INSTANTIATE_TEST_SUITE_P(Integrators, OracleTest, testing::ValuesIn(integrator_names()));

// An isotropic point light in fog of albedo one, seen along a ray that ends at a black disk
// [Sun05], literature note G1.
struct Airlight {
  float beta, distance_to_light, gamma, distance_to_disk;
  double expected;
};

double airlight(const std::string& integrator, const Airlight& a, RunningMoments& moments) {
  SceneDescription d;
  d.camera = test::camera({0, 0, 0}, {0, 0, 1});
  d.camera_medium = 0;
  d.media.push_back(test::grey_fog(a.beta, 0));
  d.surfaces.push_back(test::diffuse_disk(a.distance_to_disk, 1000, 0));
  d.lights.push_back(Light(PointLight{
      Vec3{std::sin(a.gamma), 0, std::cos(a.gamma)} * a.distance_to_light, Rgb(1)}));
  const Scene scene(std::move(d));
  moments = estimate(scene, test::settings(integrator, 1, {1, 1}), sample_count(400'000),
                     [](Sampler&) {
                       return Ray{{0, 0, 0}, {0, 0, 1}};
                     });
  return a.expected;
}

TEST_P(OracleTest, AirlightOfAPointLight) {
  RunningMoments moments;
  const double near = airlight(GetParam(), {0.5f, 2, 0.6f, 5, 0.0167522274380905}, moments);
  expect_mean(moments, near, 0.005);
  const double behind = airlight(GetParam(), {1.3f, 1, 1.8f, 20, 0.0105012378376}, moments);
  expect_mean(moments, behind, 0.005);
}

// Fluence of once scattered light at distance r from a unit isotropic source in infinite
// fog, literature note G3: the mean radiance over all directions times 4 pi.
TEST_P(OracleTest, OnceScatteredFluence) {
  const struct {
    float sigma_t, r;
    double fluence;
  } cases[] = {{0.5f, 1, 0.0718280007}, {2, 1, 0.00941258109}, {0.5f, 0.5f, 0.2188342027}};
  for (const auto& c : cases) {
    // sigma_s = 1 in the note: scale, since sigma_s may not exceed sigma_t.
    const float sigma_s = std::min(1.0f, c.sigma_t);
    SceneDescription d;
    d.camera = test::camera({0, 0, 0}, {0, 0, 1});
    d.camera_medium = 0;
    d.media.push_back(test::grey_fog(sigma_s, c.sigma_t - sigma_s));
    d.lights.push_back(Light(PointLight{{c.r, 0, 0}, Rgb(inv_4pi)}));
    const Scene scene(std::move(d));
    const RunningMoments moments =
        estimate(scene, test::settings(GetParam(), 1, {1, 1}), sample_count(400'000),
                 [](Sampler& sampler) {
                   return Ray{{0, 0, 0}, sample_uniform_sphere(sampler.next_2d())};
                 });
    // Next event estimation alone has infinite variance here: paths may come as close to
    // the light as they like.
    const double precision = GetParam() == "volpath" ? 0.15 : 0.01;
    expect_mean(moments, c.fluence * double{sigma_s} / (4 * 3.14159265358979), precision);
  }
}

// Light scattered twice where nothing is absorbed, in isotropic fog so thin that its
// transmittance is one to 1e-6: literature note G2. Path tracing finds nothing here. The
// disk that ends the ray is so small that what it hides is less still.
TEST(ThinFog, LightScatteredTwice) {
  constexpr float sigma_s = 1e-8f;
  for (const std::string integrator : {"jis", "learned"}) {
    SceneDescription d;
    d.camera = test::camera({0, 0, 0}, {0, 0, 1});
    d.camera_medium = 0;
    d.media.push_back(test::grey_fog(sigma_s, 0));
    d.surfaces.push_back(test::diffuse_disk(5, 1e-5f, 0));
    d.lights.push_back(Light(PointLight{{1, 0, 2}, Rgb(1)}));
    const Scene scene(std::move(d));
    const RunningMoments found = estimate(scene, test::settings(integrator, 2, {2, 2}),
                                          sample_count(100'000), [](Sampler&) {
                                            return Ray{{0, 0, 0}, {0, 0, 1}};
                                          });
    const double expected = double{sigma_s} * double{sigma_s} * 4 * 3.14159265358979 / 64 *
                            (std::asinh(3.0) + std::asinh(2.0));
    show(found, expected);
    EXPECT_NEAR(found.mean(), expected, 3 * found.standard_error() + 2e-6 * expected);
    EXPECT_LT(found.standard_error(), 2e-3 * expected);
  }
}

// Surroundings of radiance one and albedo one: every pixel is one, whatever is in between.
class FurnaceTest : public OracleTest {};
INSTANTIATE_TEST_SUITE_P(Integrators, FurnaceTest, testing::ValuesIn(integrator_names()));

RunningMoments furnace(const std::string& integrator, Medium medium, Vec3 eye, int count) {
  SceneDescription d;
  d.camera = test::camera(eye, {0, 0, 0});
  d.media.push_back(std::move(medium));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.lights.push_back(Light(ConstantEnvironment{Rgb(1)}));
  const Scene scene(std::move(d));
  return estimate(scene, test::settings(integrator, 100'000), count, [&](Sampler& sampler) {
    const Vec3 target = sample_uniform_sphere(sampler.next_2d()) * 0.9f;
    return Ray{eye, normalize(target - eye)};
  });
}

TEST_P(FurnaceTest, HomogeneousMediumFromOutsideAndInside) {
  for (const float g : {-0.5f, 0.0f, 0.9f}) {
    expect_mean(furnace(GetParam(), test::grey_fog(3, 0, g), {0, 0.3f, -4}, 20'000), 1,
                0.01);
    expect_mean(furnace(GetParam(), test::grey_fog(3, 0, g), {0, 0.3f, 0.2f}, 20'000), 1,
                0.01);
  }
}

TEST_P(FurnaceTest, GridMediumFromOutsideAndInside) {
  const Transform turned =
      Transform::rotate(30, {1, 2, 3}) * Transform::scale({1.2f, -0.8f, 1.5f});
  for (const Vec3 eye : {Vec3{0, 0.3f, -4}, Vec3{0, 0.3f, 0.2f}})
    expect_mean(
        furnace(GetParam(), test::constant_grid(3, 0, 0.5f, 0.7f, turned), eye, 20'000), 1,
        0.01);
}

// Absorption only, through nested spheres: Beer-Lambert, by distances between boundaries.
TEST_P(OracleTest, NestedAbsorbersFollowBeerLambert) {
  SceneDescription d;
  d.media.push_back(test::grey_fog(0, 0.4f));
  d.media.push_back(test::grey_fog(0, 1.1f));
  d.surfaces.push_back(test::boundary_sphere(2, {}, 0, no_medium));
  d.surfaces.push_back(test::boundary_sphere(1, {}, 1, 0));
  d.lights.push_back(Light(ConstantEnvironment{Rgb(1)}));
  for (const float z : {-5.0f, -1.5f, -0.5f}) {
    SceneDescription copy = d;
    copy.camera = test::camera({0, 0, z}, {0, 0, 10});
    const Scene scene(std::move(copy));
    const RunningMoments moments =
        estimate(scene, test::settings(GetParam(), 8), 50'000, [&](Sampler&) {
          return Ray{{0, 0, z}, {0, 0, 1}};
        });
    const double outer = z < -2 ? 2 : z < -1 ? 1 + (-1.0 - double{z}) : 1;
    const double inner = z < -1 ? 2 : 1 - double{z};
    expect_mean(moments, std::exp(-0.4 * outer - 1.1 * inner), 0.05);
  }
}

// A grid of constant density is a homogeneous medium.
TEST_P(OracleTest, ConstantGridEqualsHomogeneousMedium) {
  const auto radiance = [&](Medium medium, uint64_t seed) {
    SceneDescription d;
    d.camera = test::camera({0, 0, -3}, {0, 0, 0});
    d.media.push_back(std::move(medium));
    d.surfaces.push_back(test::boundary_sphere(1));
    d.lights.push_back(Light(PointLight{{0.5f, 0.9f, -1.5f}, Rgb(5)}));
    const Scene scene(std::move(d));
    RenderSettings s = test::settings(GetParam(), 16);
    s.seed = seed;
    return estimate(scene, s, 100'000, [](Sampler& sampler) {
      return Ray{{0, 0, -3}, normalize(Vec3{sampler.next_1d() - 0.5f, 0.1f, 2.5f})};
    });
  };
  const Transform turned = Transform::rotate(70, {1, 1, 0}) * Transform::scale({1, 1, -2});
  const RunningMoments fog = radiance(test::grey_fog(1.5f, 0.3f, 0.6f), 1);
  const RunningMoments grid =
      radiance(test::constant_grid(1.5f, 0.3f, 0.6f, 1.1f, turned), 2);
  EXPECT_LT(fog.standard_error(), 0.02 * fog.mean());
  EXPECT_GT(welch_p_value(fog, grid), 1e-3) << fog.mean() << " vs " << grid.mean();
}

// The orders of scattering add up to the whole picture.
TEST_P(OracleTest, OrdersAddUp) {
  SceneDescription d;
  d.camera = test::camera({0, 0, 0}, {0, 0, 1});
  d.camera_medium = 0;
  d.media.push_back(test::grey_fog(0.3f, 0.1f, 0.3f));
  d.surfaces.push_back(test::diffuse_disk(4, 3, 0.6f));
  d.lights.push_back(Light(PointLight{{1, 1, 2}, Rgb(4)}));
  const Scene scene(std::move(d));
  const auto radiance = [&](ScatteringOrders orders, uint64_t seed) {
    RenderSettings s = test::settings(GetParam(), 3, orders);
    s.seed = seed;
    return estimate(scene, s, 200'000, [](Sampler&) {
      return Ray{{0, 0, 0}, normalize(Vec3{0.2f, 0, 1})};
    });
  };
  const RunningMoments whole = radiance({}, 1);
  double sum = 0, variance = 0;
  for (int order = 0; order <= 3; ++order) {
    const RunningMoments part = radiance({order, order}, static_cast<uint64_t>(order) + 2);
    EXPECT_GT(part.mean(), 0);
    sum += part.mean();
    variance += sqr(part.standard_error());
  }
  const double error = std::sqrt(variance + sqr(whole.standard_error()));
  EXPECT_LT(error, 0.05 * whole.mean());
  EXPECT_GT(z_p_value(whole.mean() - sum, error, 0), 1e-3) << whole.mean() << " " << sum;
}

}  // namespace
}  // namespace tyndall
