// SPDX-License-Identifier: Apache-2.0
// Transformations, scopes, instances, inclusion.
#include <gtest/gtest.h>

#include "parse.h"

namespace tyndall {
namespace {

using test::parse_world;

// Where the origin of a sphere comes to lie.
Vec3 origin(const Surface& surface) {
  return std::get<Sphere>(surface.shape).world_from_sphere.point({0, 0, 0});
}

Vec3 origin_after(const std::string& directives) {
  return origin(test::surface_of(directives + "\nShape \"sphere\"\n"));
}

void expect_near(Vec3 actual, Vec3 expected) {
  EXPECT_LT(distance(actual, expected), 1e-5f)
      << actual.x << ' ' << actual.y << ' ' << actual.z;
}

TEST(LoadTransformTest, LaterOnesApplyFirst) {
  expect_near(origin_after("Translate 1 0 0 Scale 2 2 2 Translate 1 2 3"), {3, 4, 6});
  expect_near(origin_after("Rotate 90 0 0 1 Translate 1 0 0"), {0, 1, 0});
  expect_near(origin_after("Translate 1 2 3 Identity"), {0, 0, 0});
}

TEST(LoadTransformTest, MatricesAreStoredByColumn) {
  const std::string matrix = "[1 0 0 0  0 1 0 0  0 0 1 0  7 8 9 1]";
  expect_near(origin_after("Translate 1 0 0 Transform " + matrix), {7, 8, 9});
  expect_near(origin_after("Translate 1 0 0 ConcatTransform " + matrix), {8, 8, 9});
}

TEST(LoadTransformTest, NamesCoordinateSystems) {
  expect_near(origin_after("Translate 1 0 0 CoordinateSystem \"here\" Identity Scale 2 2 2 "
                           "CoordSysTransform \"here\" Translate 0 1 0"),
              {1, 1, 0});
}

TEST(LoadTransformTest, CameraIsACoordinateSystem) {
  const LoadedScene loaded = parse_world("CoordSysTransform \"camera\" Shape \"sphere\"",
                                         "LookAt 4 5 6  0 0 0  0 1 0");
  expect_near(origin(loaded.scene.surfaces[0]), {0, 0, 0});
  expect_near(to_float(loaded.scene.world_origin), {4, 5, 6});
}

TEST(LoadTransformTest, OnlyTheStartOfMotionCounts) {
  expect_near(
      origin_after("ActiveTransform EndTime Translate 5 5 5 ActiveTransform StartTime "
                   "Translate 1 0 0 ActiveTransform All Translate 0 1 0"),
      {1, 1, 0});
}

TEST(LoadScopeTest, AttributeEndRestoresEverything) {
  const LoadedScene loaded = parse_world(R"(
    AttributeBegin
      Translate 1 2 3
      ReverseOrientation
      Material "diffuse" "rgb reflectance" [.1 .2 .3]
      AreaLightSource "diffuse" "rgb L" [1 2 3]
      Shape "sphere"
    AttributeEnd
    Shape "sphere")");
  ASSERT_EQ(loaded.scene.surfaces.size(), 2u);
  const Surface& inner = loaded.scene.surfaces[0];
  EXPECT_TRUE(std::get<Sphere>(inner.shape).flip_normals);
  EXPECT_EQ(std::get<DiffuseBsdf>(inner.material).reflectance, (Rgb{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(inner.emission->L, (Rgb{1, 2, 3}));
  const Surface& outer = loaded.scene.surfaces[1];
  expect_near(origin(outer), {0, 0, 0});
  EXPECT_FALSE(std::get<Sphere>(outer.shape).flip_normals);
  EXPECT_EQ(std::get<DiffuseBsdf>(outer.material).reflectance, Rgb(0.5f));
  EXPECT_FALSE(outer.emission);
}

TEST(LoadScopeTest, TransformEndRestoresTheTransformationOnly) {
  const LoadedScene loaded = parse_world(
      "TransformBegin Translate 1 2 3 Material \"interface\" TransformEnd Shape "
      "\"sphere\"");
  expect_near(origin(loaded.scene.surfaces[0]), {0, 0, 0});
  EXPECT_TRUE(std::holds_alternative<InterfaceBsdf>(loaded.scene.surfaces[0].material));
}

TEST(LoadScopeTest, AttributesAreDefaults) {
  const LoadedScene loaded = parse_world(R"(
    AttributeBegin
      Attribute "shape" "float radius" 2 "float height" 9
      Attribute "shape" "float radius" 3
      Shape "sphere"
      Shape "sphere" "float radius" 4
    AttributeEnd
    Shape "sphere")");
  const auto radius = [&](size_t i) {
    return std::get<Sphere>(loaded.scene.surfaces[i].shape).radius;
  };
  EXPECT_EQ(radius(0), 3);
  EXPECT_EQ(radius(1), 4);
  EXPECT_EQ(radius(2), 1);
}

TEST(LoadInstanceTest, InstancesMoveWhatTheirObjectPlaced) {
  const LoadedScene loaded = parse_world(R"(
    Translate 1 0 0
    ObjectInstance "later"
    Identity
    Scale 2 2 2
    ObjectBegin "later"
      Translate 0 1 0
      Shape "sphere"
      Shape "disk"
    ObjectEnd
    ObjectInstance "later")");
  EXPECT_TRUE(loaded.scene.surfaces.empty());
  ASSERT_EQ(loaded.scene.objects.size(), 1u);
  ASSERT_EQ(loaded.scene.objects[0].size(), 2u);
  expect_near(origin(loaded.scene.objects[0][0]), {0, 2, 0});
  ASSERT_EQ(loaded.scene.instances.size(), 2u);
  expect_near(loaded.scene.instances[0].world_from_object.point({0, 0, 0}), {1, 0, 0});
  expect_near(loaded.scene.instances[1].world_from_object.vector({1, 0, 0}), {2, 0, 0});
}

TEST(LoadSurfaceTest, SurfacesSayWhereTheyCameFrom) {
  EXPECT_EQ(test::surface_of("\n  Shape \"sphere\"").name, "sphere at test.pbrt:6:3");
}

TEST(LoadIncludeTest, ImportKeepsItsStateToItself) {
  const std::string folder = TYNDALL_SOURCE_DIR "/tests/loader/scenes";
  const LoadedScene loaded = load_scene(folder + "/include.pbrt");
  ASSERT_EQ(loaded.scene.surfaces.size(), 3u);
  expect_near(origin(loaded.scene.surfaces[0]), {1, 0, 0});  // in the included file
  expect_near(origin(loaded.scene.surfaces[1]), {2, 0, 0});  // in the imported file
  expect_near(origin(loaded.scene.surfaces[2]), {1, 0, 0});  // after both
}

}  // namespace
}  // namespace tyndall
