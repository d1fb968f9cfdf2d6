// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "parse.h"

namespace tyndall {
namespace {

Medium medium_of(const std::string& parameters, const std::string& before = "") {
  return test::parse_world(before + " MakeNamedMedium \"m\" " + parameters)
      .scene.media.at(0);
}

MediumProperties properties_of(const std::string& parameters) {
  return medium_of("\"string type\" \"homogeneous\" " + parameters).at({});
}

void expect_near(Rgb actual, Rgb expected) {
  for (int i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(actual[i], expected[i]) << i;
}

TEST(LoadHomogeneousTest, HasPbrtsDefaults) {
  const MediumProperties milk = properties_of("");
  expect_near(milk.sigma_a, {0.0011f, 0.0024f, 0.014f});
  expect_near(milk.sigma_s, {2.55f, 3.21f, 3.77f});
  EXPECT_TRUE(is_black(milk.Le));
  expect_near(properties_of("\"rgb sigma_s\" [1 2 3]").sigma_a, {0.0011f, 0.0024f, 0.014f});
}

TEST(LoadHomogeneousTest, ReadsCoefficients) {
  const MediumProperties p = properties_of(
      "\"rgb sigma_a\" [1 2 3] \"spectrum sigma_s\" [200 4 900 4] \"float scale\" 2 "
      "\"rgb Le\" [1 2 3] \"float Lescale\" 5");
  expect_near(p.sigma_a, {2, 4, 6});
  expect_near(p.sigma_s, Rgb(8));
  expect_near(p.Le, {5, 10, 15});
}

TEST(LoadHomogeneousTest, PresetsScale) {
  const MediumProperties p =
      properties_of("\"string preset\" \"Skin1\" \"float scale\" 10");
  expect_near(p.sigma_s, {7.4f, 8.8f, 10.1f});
  expect_near(p.sigma_a, {0.32f, 1.7f, 4.8f});
}

TEST(LoadHomogeneousTest, ReadsThePhaseFunction) {
  EXPECT_EQ(medium_of("\"string type\" \"homogeneous\"").phase().mean_cosine(), 0);
  EXPECT_EQ(
      medium_of("\"string type\" \"homogeneous\" \"float g\" -.7").phase().mean_cosine(),
      -0.7f);
}

TEST(LoadUniformGridTest, DensityScalesUnitCoefficients) {
  const Medium medium = medium_of(
      "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"float density\" [1 3] "
      "\"point3 p1\" [2 1 1] \"float scale\" 2",
      "Translate 10 0 0");
  EXPECT_NEAR(medium.at({10.5f, 0.5f, 0.5f}).sigma_a.g, 2, 1e-5);
  EXPECT_NEAR(medium.at({11.5f, 0.5f, 0.5f}).sigma_s.g, 6, 1e-5);
  EXPECT_NEAR(medium.at({11.0f, 0.5f, 0.5f}).sigma_s.g, 4, 1e-5);
  EXPECT_TRUE(is_black(medium.at({12.5f, 0.5f, 0.5f}).sigma_s));
}

// x runs fastest, then y, then z.
TEST(LoadUniformGridTest, OrderOfValues) {
  const Medium medium = medium_of(
      "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2 "
      "\"float density\" [0 1 2 3 4 5 6 7]");
  for (int i = 0; i < 8; ++i) {
    const Vec3 center{i & 1 ? 0.75f : 0.25f, i & 2 ? 0.75f : 0.25f, i & 4 ? 0.75f : 0.25f};
    EXPECT_NEAR(medium.at(center).sigma_s.g, i, 1e-5) << i;
  }
}

TEST(LoadMediumTest, SurfacesKnowTheirMedia) {
  const LoadedScene loaded = test::parse_world(R"(
    Shape "sphere"
    MediumInterface "later" ""
    Shape "sphere"
    MakeNamedMedium "first" "string type" "homogeneous"
    MakeNamedMedium "later" "string type" "homogeneous"
    MediumInterface "first"
    Shape "sphere")");
  const auto media = [&](size_t i) { return loaded.scene.surfaces[i].media; };
  EXPECT_FALSE(media(0).is_stated);
  EXPECT_FALSE(media(0).is_transition());
  EXPECT_TRUE(media(1).is_stated);
  EXPECT_EQ(media(1).inside, 1);
  EXPECT_EQ(media(1).outside, no_medium);
  EXPECT_EQ(media(2).inside, 0);
  EXPECT_EQ(media(2).outside, 0);
}

TEST(LoadMediumTest, AGlowingMediumIsALight) {
  const std::string scene =
      "Camera \"perspective\" MakeNamedMedium \"m\" \"string type\" \"homogeneous\" ";
  EXPECT_EQ(test::error_of(scene + "\"rgb Le\" [1 1 1] WorldBegin"), "");
  EXPECT_NE(test::error_of(scene + "WorldBegin"), "");
}

}  // namespace
}  // namespace tyndall
