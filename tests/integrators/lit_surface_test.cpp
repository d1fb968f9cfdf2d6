// SPDX-License-Identifier: Apache-2.0
// Connections to surfaces that lights shine on, against plain path tracing.
#include "tyndall/integrators/lit_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"
#include "support/statistical_tests.h"
#include "tyndall/sampling/warps.h"

namespace tyndall {
namespace {

// A lamp under an open shade in a foggy room of diffuse walls: light reaches the camera
// over the shade's inside and the walls.
SceneDescription shaded_room(const std::string& lamp) {
  SceneDescription d;
  d.camera = test::camera({-0.8f, 0.3f, -0.8f}, {0.3f, 0, 0.3f}, 70, {8, 8});
  d.media.push_back(test::grey_fog(0.3f, 0.05f, 0.5f));
  Surface room = test::boundary_box(1, 0, 0);
  room.material = DiffuseBsdf{Rgb(0.6f)};
  d.surfaces.push_back(room);
  Surface shade = test::boundary_sphere(0.3f, {0.2f, 0.2f, 0.2f}, 0, 0);
  std::get<Sphere>(shade.shape).z_min = -0.1f;  // open below
  shade.material = DiffuseBsdf{Rgb(0.7f)};
  d.surfaces.push_back(shade);
  const Vec3 p{0.2f, 0.2f, 0.25f};
  if (lamp == "point") d.lights.push_back(Light(PointLight{p, Rgb(1)}));
  if (lamp == "spot")
    d.lights.push_back(Light(SpotLight{.p = p,
                                       .axis = {0, 0, -1},
                                       .I = Rgb(3),
                                       .cos_total = 0.3f,
                                       .cos_falloff_start = 0.6f}));
  if (lamp == "sphere" || lamp == "disk") {
    Surface bulb = test::boundary_sphere(0.06f, p, 0, 0);
    if (lamp == "disk")
      bulb.shape = Disk{Transform::translate(p), 0, 0.1f, 0, 2 * pi, true};
    bulb.material = DiffuseBsdf{Rgb(0)};
    bulb.emission = AreaEmission{Rgb(30), lamp == "disk"};
    d.surfaces.push_back(bulb);
  }
  return d;
}

// Far from what scatters: light comes through a narrow cone.
void add_far_lamp(SceneDescription& d, const std::string& lamp) {
  const Vec3 p = 20 * normalize(Vec3{0.3f, -0.2f, 1});
  if (lamp == "far point") d.lights.push_back(Light(PointLight{p, Rgb(1200)}));
  if (lamp == "far spot")
    d.lights.push_back(Light(SpotLight{.p = p,
                                       .axis = normalize(-p),
                                       .I = Rgb(1200),
                                       .cos_total = 0.9f,
                                       .cos_falloff_start = 0.95f}));
  if (lamp != "far sphere") return;
  Surface sun = test::boundary_sphere(0.4f, p, no_medium, no_medium);
  sun.material = DiffuseBsdf{Rgb(0)};
  sun.emission = AreaEmission{Rgb(2400), false};
  d.surfaces.push_back(sun);
}

// A foggy box between a floor and a roof with a round hole, under the sun or a sky.
SceneDescription open_room(const std::string& light) {
  SceneDescription d;
  d.camera = test::camera({-0.8f, 0.1f, -0.1f}, {0.3f, 0, -0.15f}, 70, {8, 8});
  d.media.push_back(test::grey_fog(0.3f, 0.05f, 0.5f));
  d.surfaces.push_back(test::boundary_box(1));
  d.surfaces.push_back(test::diffuse_disk(-0.5f, 1.4f, 0.6f));
  Surface roof = test::diffuse_disk(0.4f, 1.4f, 0.6f);
  std::get<Disk>(roof.shape).inner_radius = 0.3f;
  d.surfaces.push_back(roof);
  d.camera_medium = 0;
  if (light == "sun")
    d.lights.push_back(Light(DistantLight{normalize(Vec3{0.3f, -0.2f, 1}), Rgb(3)}));
  else if (light.starts_with("far"))
    add_far_lamp(d, light);
  else
    d.lights.push_back(Light(ConstantEnvironment{Rgb(1)}));
  return d;
}

bool is_outside(const std::string& light) {
  return light == "sun" || light == "sky" || light.starts_with("far");
}

SceneDescription lit_room(const std::string& light) {
  return is_outside(light) ? open_room(light) : shaded_room(light);
}

class LitSurfaceTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Lamps, LitSurfaceTest,
                         testing::Values("point", "spot", "sphere", "disk", "sun",
                                         "far point", "far spot", "far sphere"));
class LitRoomTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Lights, LitRoomTest,
                         testing::Values("point", "spot", "sphere", "disk", "sun", "sky",
                                         "far spot", "far sphere"));

struct Mean {
  double value = 0, variance = 0;
};

Mean mean_of_picture(const Scene& scene, const std::string& integrator,
                     ScatteringOrders orders, uint32_t spp) {
  RenderSettings s = test::settings(integrator, 7, orders);
  s.resolution = s.crop_max = {8, 8};
  s.samples_per_pixel = spp;
  const Image image = render(scene, s).film.develop();
  Mean mean;
  for (int i = 0; i < 64; ++i) {
    mean.value += double{image.find("G")->values[i]} / 64;
    mean.variance += double{image.find("variance.G")->values[i]} / (64 * 64);
  }
  return mean;
}

void expect_agreement(const Scene& scene, ScatteringOrders orders, double precision) {
  const Mean learned = mean_of_picture(scene, "learned", orders, 700);
  const Mean reference = mean_of_picture(scene, "volpath", orders, 5000);
  const double error = std::sqrt(learned.variance + reference.variance);
  EXPECT_LT(std::abs(learned.value - reference.value), 3 * error)
      << learned.value << " instead of " << reference.value;
  EXPECT_LT(error, precision * reference.value);
}

TEST_P(LitRoomTest, AgreesWithPathTracingOverSurfaces) {
  expect_agreement(Scene(lit_room(GetParam())), {0, 0}, 0.06);
}

TEST_P(LitRoomTest, AgreesWithPathTracingInFog) {
  expect_agreement(Scene(lit_room(GetParam())), {1, 20}, 0.06);
}

// The density of evenly chosen rays, apart from the cosine at the surface.
float expected_base(const std::string& lamp, const Light& light, const LitPoint& lit) {
  const float distance = lit.edge[0].length;
  if (lamp == "point") return inv_4pi / sqr(distance);
  if (lamp == "spot") return uniform_cone_pdf(0.7f) / sqr(distance);
  const float pdf = 1 / (lit.flux.r * lit.choice.density);  // of emission one
  if (lamp == "sun") return 3 * pdf;
  if (lamp == "far sphere") return 2400 * pdf;
  if (lamp == "far point") return 1200 * pdf / sqr(distance);
  if (const auto* spot = std::get_if<SpotLight>(&light.variant()); spot && lamp != "spot")
    return spot->intensity(-lit.to_light()).r * pdf / sqr(distance);
  const float area_of_light = area(*std::get<AreaLight>(light.variant()).shape);
  return inv_pi / area_of_light / (lamp == "disk" ? 2.0f : 1.0f);
}

std::optional<LitPoint> draw(const LitSurfaceSampling& sampling, size_t place,
                             RandomStream& random) {
  const float u = random.next_1d();
  const Vec2 u_point = random.next_2d();
  return sampling.sample(place, u, u_point, random.next_2d(), random);
}

// What sample() says of a direct walk is what densities() says of its first surface.
TEST_P(LitSurfaceTest, DensitiesAreThoseOfTheSamples) {
  const Scene scene(lit_room(GetParam()));
  LitSurfaceSampling sampling(scene, 3, 2);
  RandomStream random(5);
  for (int pass = 0; pass < 2; ++pass) {
    for (int i = 0; i < 2000; ++i) {
      const size_t place = i % 2;
      const std::optional<LitPoint> lit = draw(sampling, place, random);
      if (!lit) continue;
      const bool is_seen = place == 0 || lit->hit.point.p.x > 0;
      sampling.record(place, *lit, is_seen ? luminance(lit->flux) : 0);
      const float distance = lit->edge[0].length;
      const float cosine = abs_dot(lit->first.point.ng, lit->to_light());
      const std::array<float, max_lit_surfaces> densities =
          sampling.densities({place, place, place}, lit->light, lit->first.point.p,
                             lit->to_light(), distance, cosine);
      if (is_outside(GetParam()) && lit->surfaces > 1) continue;  // flux has reflectances
      const float base = expected_base(GetParam(), scene.lights()[0], *lit);
      const float expected = lit->choice.density * base * cosine;
      // Where the direction is at the border of a cell, rounding may choose the other.
      if (std::abs(densities[lit->surfaces - 1] - expected) > 1e-3f * expected) {
        const float x = lit->choice.p.x * 32, y = lit->choice.p.y * 32;
        EXPECT_LT(std::min(std::abs(x - std::round(x)), std::abs(y - std::round(y))),
                  0.01f);
      }
    }
    sampling.update();
  }
}

// Of evenly chosen rays of a lamp so far away one in 1600 would get into the room.
TEST_P(LitSurfaceTest, FindsSurfacesHoweverFarTheLamp) {
  const Scene scene(lit_room(GetParam()));
  const LitSurfaceSampling sampling(scene, 1);
  RandomStream random(7);
  int found = 0;
  for (int i = 0; i < 1000; ++i) found += draw(sampling, 0, random) ? 1 : 0;
  EXPECT_GT(found, 200);
}

// Walks over more surfaces start from the light and carry what is left of its power.
TEST(LitSurface, WalksFromTheLight) {
  const Scene scene(shaded_room("point"));
  const LitSurfaceSampling sampling(scene, 4);
  RandomStream random(6);
  int longest = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::optional<LitPoint> lit = draw(sampling, 0, random);
    if (!lit) continue;
    longest = std::max(longest, lit->surfaces);
    EXPECT_EQ(lit->chain.size, lit->surfaces - 1);
    const Vec3 start = lit->first.point.p + lit->to_light() * lit->edge[0].length;
    EXPECT_NEAR(distance(start, {0.2f, 0.2f, 0.25f}), 0, 1e-4f);
    EXPECT_GT(lit->flux.r, 0);
  }
  EXPECT_EQ(longest, 4);
}

}  // namespace
}  // namespace tyndall
