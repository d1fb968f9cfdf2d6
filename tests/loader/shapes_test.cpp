// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "parse.h"

namespace tyndall {
namespace {

using test::parse_world;
using test::surface_of;

constexpr float full_turn = 2 * std::numbers::pi_v<float>;

TEST(LoadShapeTest, QuadricsHavePbrtsDefaults) {
  const Surface sphere_surface = surface_of("Shape \"sphere\" \"float radius\" 2");
  const Sphere& sphere = std::get<Sphere>(sphere_surface.shape);
  EXPECT_EQ(sphere.radius, 2);
  EXPECT_EQ(sphere.z_min, -2);
  EXPECT_EQ(sphere.z_max, 2);
  EXPECT_FLOAT_EQ(sphere.phi_max, full_turn);
  const Surface disk_surface = surface_of("Shape \"disk\" \"float height\" 3");
  const Disk& disk = std::get<Disk>(disk_surface.shape);
  EXPECT_EQ(disk.height, 3);
  EXPECT_EQ(disk.radius, 1);
  EXPECT_EQ(disk.inner_radius, 0);
  EXPECT_FLOAT_EQ(disk.phi_max, full_turn);
}

TEST(LoadShapeTest, ClipsAreOrderedAndWithinTheSphere) {
  const Surface surface = surface_of(
      "Shape \"sphere\" \"float zmin\" 7 \"float zmax\" -.5 \"float phimax\" 90");
  const Sphere& sphere = std::get<Sphere>(surface.shape);
  EXPECT_EQ(sphere.z_min, -0.5f);
  EXPECT_EQ(sphere.z_max, 1);
  EXPECT_FLOAT_EQ(sphere.phi_max, full_turn / 4);
}

TEST(LoadShapeTest, OneTriangleNeedsNoIndices) {
  const Surface surface =
      surface_of("Translate 0 0 5 Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]");
  const TriangleMesh& mesh = std::get<TriangleMesh>(surface.shape);
  EXPECT_EQ(mesh.triangles(), (std::vector<Vec3i>{{0, 1, 2}}));
  EXPECT_EQ(mesh.positions(), (std::vector<Vec3>{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}));
}

const std::string triangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]";

Vec3 outside_of(const std::string& world) {
  return surface_point(surface_of(world).shape, 0, {0.25f, 0.25f}).ng;
}

TEST(LoadShapeTest, OrientationFollowsPbrt) {
  EXPECT_EQ(outside_of(triangle), (Vec3{0, 0, 1}));
  EXPECT_EQ(outside_of("ReverseOrientation " + triangle), (Vec3{0, 0, -1}));
  // A mirror turns winding and handedness: outside stays what it was in object space.
  EXPECT_EQ(outside_of("Scale -1 1 1 " + triangle), (Vec3{0, 0, 1}));
  EXPECT_EQ(outside_of("Scale 1 1 -1 " + triangle), (Vec3{0, 0, -1}));
  // Normals decide where they are given.
  const std::string normals = " \"normal N\" [0 0 -1 0 0 -1 0 0 -1]";
  EXPECT_EQ(outside_of(triangle + normals), (Vec3{0, 0, -1}));
  EXPECT_EQ(outside_of("ReverseOrientation " + triangle + normals), (Vec3{0, 0, 1}));
}

// As pbrt-v4: a mirror alone turns a sphere inside out; exporters of left-handed worlds add
// ReverseOrientation.
TEST(LoadShapeTest, OrientationOfQuadricsFollowsPbrt) {
  const auto faces_out = [](const std::string& world) {
    const SurfacePoint on =
        surface_point(surface_of(world + " Shape \"sphere\"").shape, 0, {0.3f, 0.4f});
    return dot(on.ng, on.p) > 0;
  };
  EXPECT_TRUE(faces_out(""));
  EXPECT_TRUE(faces_out("Rotate 50 1 2 3"));
  EXPECT_FALSE(faces_out("ReverseOrientation"));
  EXPECT_FALSE(faces_out("Scale 1 1 -1"));
  EXPECT_TRUE(faces_out("ReverseOrientation Scale 1 1 -1"));
  const std::string disk = "Shape \"disk\"";
  EXPECT_EQ(outside_of(disk), (Vec3{0, 0, 1}));
  EXPECT_EQ(outside_of("Scale -1 1 1 " + disk), (Vec3{0, 0, -1}));
  EXPECT_EQ(outside_of("ReverseOrientation Scale -1 1 1 " + disk), (Vec3{0, 0, 1}));
}

TEST(LoadShapeTest, BilinearMeshesFaceByTheirCorners) {
  const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]";
  EXPECT_EQ(outside_of(patch), (Vec3{0, 0, 1}));
  EXPECT_EQ(outside_of("ReverseOrientation " + patch), (Vec3{0, 0, -1}));
  EXPECT_EQ(outside_of("Scale -1 1 1 " + patch), (Vec3{0, 0, 1}));
}

TEST(LoadShapeTest, InvisibleShapesAreLeftOut) {
  EXPECT_TRUE(parse_world("Shape \"sphere\" \"float alpha\" 0").scene.surfaces.empty());
  EXPECT_EQ(parse_world("Shape \"sphere\" \"float alpha\" 1").scene.surfaces.size(), 1u);
  EXPECT_EQ(surface_of("Shape \"sphere\" \"float alpha\" .25").alpha, 0.25f);
  EXPECT_EQ(surface_of("Texture \"half\" \"float\" \"constant\" \"float value\" .5 "
                       "Shape \"sphere\" \"texture alpha\" \"half\"")
                .alpha,
            0.5f);
  // The light of an invisible lamp is not lost.
  const LoadedScene lamp = parse_world(
      "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"bool twosided\" true "
      "Translate 0 0 5 Shape \"sphere\" \"float alpha\" 0");
  EXPECT_TRUE(lamp.scene.surfaces.empty());
  ASSERT_EQ(lamp.scene.hidden_emitters.size(), 1u);
  const HiddenEmitter& hidden = lamp.scene.hidden_emitters[0];
  EXPECT_EQ(hidden.emission.L, (Rgb{1, 2, 3}));
  EXPECT_TRUE(hidden.emission.two_sided);
  EXPECT_EQ(bounds(hidden.shape).center(), (Vec3{0, 0, 5}));
}

TEST(LoadAreaLightTest, EmitsItsRadiance) {
  const Surface surface = surface_of(
      "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 2 \"bool twosided\" "
      "true "
      "Shape \"sphere\"");
  ASSERT_TRUE(surface.emission);
  EXPECT_EQ(surface.emission->L, (Rgb{2, 4, 6}));
  EXPECT_TRUE(surface.emission->two_sided);
}

// A Lambertian emitter of area A and radiance L has the power pi A L on one side.
TEST(LoadAreaLightTest, PowerIsSharedOutOverTheArea) {
  const Surface sphere =
      surface_of("AreaLightSource \"diffuse\" \"float power\" 100 Shape \"sphere\"");
  const float area = 4 * std::numbers::pi_v<float>;
  EXPECT_NEAR(sphere.emission->L.g * std::numbers::pi_v<float> * area, 100, 1e-3);
  const Surface both = surface_of(
      "AreaLightSource \"diffuse\" \"float power\" 100 \"bool twosided\" true Shape "
      "\"sphere\"");
  EXPECT_NEAR(2 * both.emission->L.g * std::numbers::pi_v<float> * area, 100, 1e-3);
}

// pbrt-v4 makes each triangle a light of its own, of the stated power.
TEST(LoadAreaLightTest, PowerHoldsForEachTriangle) {
  const std::string light =
      "ReverseOrientation AreaLightSource \"diffuse\" \"float power\" 6 "
      "Shape \"trianglemesh\" \"point3 P\" ";
  const LoadedScene square =
      parse_world(light + "[0 0 0 1 0 0 1 1 0 0 1 0] \"integer indices\" [0 1 2 0 2 3]");
  ASSERT_EQ(square.scene.surfaces.size(), 1u);
  EXPECT_NEAR(square.scene.surfaces[0].emission->L.g, 12 / std::numbers::pi, 1e-5);
  const LoadedScene uneven =
      parse_world(light + "[0 0 0 1 0 0 1 1 0 0 3 0] \"integer indices\" [0 1 2 0 2 3]");
  ASSERT_EQ(uneven.scene.surfaces.size(), 2u);
  for (const Surface& part : uneven.scene.surfaces) {
    EXPECT_NEAR(part.emission->L.g * std::numbers::pi_v<float> * area(part.shape), 6, 1e-5);
    EXPECT_EQ(surface_point(part.shape, 0, {0.25f, 0.25f}).ng, (Vec3{0, 0, -1}));
  }
}

TEST(LoadShapeTest, ReadsPlyThroughTheTransformation) {
  const std::string name = TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/good.ply.gz";
  const Surface surface =
      surface_of("Scale 2 2 2 Shape \"plymesh\" \"string filename\" \"" + name + "\"");
  EXPECT_EQ(std::get<TriangleMesh>(surface.shape).positions(),
            (std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}));
}

}  // namespace
}  // namespace tyndall
