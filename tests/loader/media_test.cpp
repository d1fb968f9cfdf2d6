// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "parse.h"
#include "tyndall/math/constants.h"
#include "tyndall/media/blackbody.h"

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

// p(wo, wi) times 4 pi, for a deflection of the given cosine.
float relative_phase(const std::string& parameters, float cosine) {
  const Medium medium = medium_of("\"string type\" \"homogeneous\" " + parameters);
  const Vec3 wi{0, std::sqrt(1 - cosine * cosine), cosine};
  return medium.phase().eval({0, 0, -1}, wi) * 4 * pi;
}

double hg(double g, double cosine) {
  return (1 - g * g) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
}

void expect_phase(const std::string& parameters, float cosine, double expected) {
  EXPECT_NEAR(double{relative_phase(parameters, cosine)}, expected, 1e-5 * expected)
      << parameters << " at " << cosine;
}

TEST(LoadPhaseTest, KnowsFourPhaseFunctions) {
  for (const float c : {-1.0f, -0.25f, 0.0f, 0.75f, 1.0f}) {
    const double cosine = double{c};
    expect_phase("", c, 1);
    expect_phase("\"string phase\" \"hg\" \"float g\" .5", c, hg(0.5, cosine));
    expect_phase(
        "\"string phase\" \"two-lobe-hg\" \"float g\" .75 \"float g2\" -.5 "
        "\"float share\" .25",
        c, 0.25 * hg(0.75, cosine) + 0.75 * hg(-0.5, cosine));
    expect_phase("\"string phase\" \"rayleigh\"", c, 0.75 * (1 + cosine * cosine));
    // Twice as much straight on as straight back, linear in between.
    expect_phase("\"string phase\" \"tabulated\" \"float values\" [2 4]", c,
                 (3 + cosine) / 3);
  }
}

TEST(LoadPhaseTest, IsReadByGridsToo) {
  for (const std::string type : {"\"homogeneous\"", "\"uniformgrid\" \"float density\" 1",
                                 "\"rgbgrid\" \"rgb sigma_s\" [1 2 3]"}) {
    const Medium medium =
        medium_of("\"string type\" " + type +
                  " \"string phase\" \"tabulated\" \"float values\" [0 1]");
    EXPECT_FLOAT_EQ(medium.phase().mean_cosine(), 1 / 3.0f) << type;
  }
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

std::vector<std::string> warnings_of(const std::string& parameters) {
  std::vector<std::string> messages;
  for (const Diagnostic& d :
       test::parse_world("MakeNamedMedium \"m\" \"string type\" " + parameters).warnings)
    messages.push_back(d.message);
  return messages;
}

TEST(LoadUniformGridTest, WarnsOfWhatCountsAsZero) {
  using Messages = std::vector<std::string>;
  const std::string large =
      "MakeNamedMedium \"m\": the density grid holds values that are no numbers or above "
      "1e+30, which count as zero";
  const std::string empty =
      "MakeNamedMedium \"m\": the density is zero everywhere: an empty medium";
  EXPECT_EQ(warnings_of("\"uniformgrid\" \"integer nx\" 2 \"float density\" [1 3e38]"),
            Messages{large});
  EXPECT_EQ(warnings_of("\"uniformgrid\" \"integer nx\" 2 \"float density\" [1 1e5]"),
            Messages{});
  EXPECT_EQ(
      warnings_of("\"uniformgrid\" \"integer nx\" 2 \"float density\" [1 1e30]"),
      Messages{"MakeNamedMedium \"m\": some densities are reduced: from one sample to "
               "the next they would make an optical depth of more than 1e6"});
  EXPECT_EQ(warnings_of("\"uniformgrid\" \"float density\" 0"), Messages{empty});
  EXPECT_EQ(warnings_of("\"uniformgrid\" \"float density\" 1e31"),
            (Messages{large, empty}));
}

TEST(LoadRgbGridTest, WarnsOfReducedCoefficients) {
  EXPECT_EQ(warnings_of("\"rgbgrid\" \"rgb sigma_s\" [1 1e5 1]"),
            std::vector<std::string>{});
  EXPECT_EQ(warnings_of("\"rgbgrid\" \"rgb sigma_s\" [1 1e29 1]"),
            std::vector<std::string>{
                "MakeNamedMedium \"m\": some densities are reduced: from one sample to the "
                "next they would make an optical depth of more than 1e6"});
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

TEST(LoadUniformGridTest, CornersMayBeSwapped) {
  const Medium medium = medium_of(
      "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"float density\" [1 3] "
      "\"point3 p0\" [2 0 1] \"point3 p1\" [0 1 0]");
  EXPECT_NEAR(medium.at({0.5f, 0.5f, 0.5f}).sigma_a.g, 1, 1e-5);
  EXPECT_NEAR(medium.at({1.5f, 0.5f, 0.5f}).sigma_a.g, 3, 1e-5);
}

TEST(LoadUniformGridTest, EmissionVaries) {
  const Medium medium = medium_of(
      "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"float density\" [1 1] "
      "\"rgb Le\" [1 2 3] \"float Lescale\" [2 4]");
  expect_near(medium.at({0.25f, 0.5f, 0.5f}).Le, {2, 4, 6});
  expect_near(medium.at({0.75f, 0.5f, 0.5f}).Le, {4, 8, 12});
  const Medium constant = medium_of(
      "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"float density\" [1 1] "
      "\"rgb Le\" [1 2 3] \"float Lescale\" 5");
  expect_near(constant.at({0.5f, 0.5f, 0.5f}).Le, {5, 10, 15});
}

TEST(LoadUniformGridTest, GlowsByTemperature) {
  for (const char* offset : {"temperatureoffset", "temperaturecutoff"}) {
    const Medium medium = medium_of(
        "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"float density\" [1 1] "
        "\"float temperature\" [.5 1.5] \"float temperaturescale\" 2000 \"float " +
        std::string(offset) + "\" .5 \"float Lescale\" 3");
    EXPECT_TRUE(is_black(medium.at({0.25f, 0.5f, 0.5f}).Le));
    expect_near(medium.at({0.75f, 0.5f, 0.5f}).Le, 3 * blackbody_radiance(2000));
  }
}

TEST(LoadRgbGridTest, ReadsColors) {
  const Medium medium = medium_of(
      "\"string type\" \"rgbgrid\" \"integer nx\" 2 \"float scale\" 2 \"float g\" .5 "
      "\"rgb sigma_a\" [1 0 0  0 1 0] \"rgb sigma_s\" [0 0 1  .5 .5 .5] "
      "\"rgb Le\" [1 2 3  0 0 1] \"float Lescale\" 10");
  const MediumProperties left = medium.at({0.25f, 0.5f, 0.5f});
  const MediumProperties right = medium.at({0.75f, 0.5f, 0.5f});
  expect_near(left.sigma_a, {2, 0, 0});
  expect_near(left.sigma_s, {0, 0, 2});
  expect_near(left.Le, {10, 20, 30});
  expect_near(right.sigma_a, {0, 2, 0});
  expect_near(right.sigma_s, Rgb(1));
  EXPECT_EQ(medium.phase().mean_cosine(), 0.5f);
}

// As in pbrt-v4, the coefficient that is not given is one.
TEST(LoadRgbGridTest, OneCoefficientIsEnough) {
  const MediumProperties p =
      medium_of("\"string type\" \"rgbgrid\" \"rgb sigma_s\" [1 2 3] \"float scale\" 2")
          .at({0.5f, 0.5f, 0.5f});
  expect_near(p.sigma_a, Rgb(2));
  expect_near(p.sigma_s, {2, 4, 6});
}

TEST(LoadCloudTest, IsDenseBelowAndThinAbove) {
  const Medium medium = medium_of(
      "\"string type\" \"cloud\" \"float sigma_a\" 0 \"float sigma_s\" 4 \"float "
      "frequency\" "
      "2 \"float wispiness\" .5 \"float density\" 2 \"point3 p0\" [0 -1 0]",
      "Translate 10 0 0");
  EXPECT_NEAR(medium.at({10.5f, -0.5f, 0.5f}).sigma_s.g, 4, 1e-4);
  EXPECT_LT(medium.at({10.5f, 0.98f, 0.5f}).sigma_s.g, 1);
  EXPECT_TRUE(is_black(medium.at({0.5f, 0.5f, 0.5f}).sigma_s));
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
