// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>

#include "parse.h"

namespace tyndall {
namespace {

constexpr float pi_f = std::numbers::pi_v<float>;

// The second light: parse_world() has one of its own.
Light light_of(const std::string& world) {
  return test::parse_world(world).scene.lights.at(1);
}

template <typename T>
T light_of(const std::string& world) {
  return std::get<T>(light_of(world).variant());
}

TEST(LoadLightTest, ReadsPoints) {
  const auto light = light_of<PointLight>(
      "Translate 1 0 0 LightSource \"point\" \"rgb I\" [1 2 3] \"float scale\" 2 "
      "\"point3 from\" [0 5 0]");
  EXPECT_EQ(light.p, (Vec3{1, 5, 0}));
  EXPECT_EQ(light.I, (Rgb{2, 4, 6}));
}

// A point of intensity I sends out 4 pi I.
TEST(LoadLightTest, PowerOfPoints) {
  EXPECT_NEAR(
      light_of<PointLight>("LightSource \"point\" \"float power\" 10").I.g * 4 * pi_f, 10,
      1e-5);
}

TEST(LoadLightTest, ReadsSpots) {
  const auto light = light_of<SpotLight>(
      "Rotate 90 0 0 1 LightSource \"spot\" \"point3 from\" [1 0 0] \"point3 to\" [3 0 0] "
      "\"float coneangle\" 60 \"float conedeltaangle\" 15");
  EXPECT_NEAR(light.p.y, 1, 1e-6);
  EXPECT_NEAR(light.axis.y, 1, 1e-6);
  EXPECT_NEAR(light.cos_total, 0.5f, 1e-6);
  EXPECT_NEAR(light.cos_falloff_start, std::sqrt(0.5f), 1e-6);
  const auto plain = light_of<SpotLight>("LightSource \"spot\"");
  EXPECT_NEAR(plain.cos_total, std::cos(pi_f / 6), 1e-6);
  EXPECT_NEAR(plain.cos_falloff_start, std::cos(25 * pi_f / 180), 1e-6);
  EXPECT_EQ(plain.axis, (Vec3{0, 0, 1}));
  EXPECT_EQ(plain.I, Rgb(1));
}

// The intensity integrated over the cone: the smooth edge counts half.
TEST(LoadLightTest, PowerOfSpots) {
  const auto light = light_of<SpotLight>("LightSource \"spot\" \"float power\" 10");
  double power = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const float z = 1 - (static_cast<float>(i) + 0.5f) / n;
    power +=
        static_cast<double>(light.intensity(spherical_direction(z, 0)).g) * 2 * pi_f / n;
  }
  EXPECT_NEAR(power, 10, 1e-2);
}

TEST(LoadLightTest, ReadsDistantLights) {
  const auto light = light_of<DistantLight>(
      "LightSource \"distant\" \"point3 from\" [0 9 0] \"point3 to\" [0 0 0] \"rgb L\" [1 "
      "1 2] "
      "\"float illuminance\" 3");
  EXPECT_EQ(light.wi, (Vec3{0, 1, 0}));
  EXPECT_EQ(light.L, (Rgb{3, 3, 6}));
}

TEST(LoadLightTest, ReadsConstantEnvironments) {
  EXPECT_EQ(light_of<ConstantEnvironment>("LightSource \"infinite\" \"rgb L\" [1 2 3] "
                                          "\"float scale\" 2")
                .L,
            (Rgb{2, 4, 6}));
  // Radiance L from everywhere makes the illuminance pi L.
  EXPECT_NEAR(
      light_of<ConstantEnvironment>("LightSource \"infinite\" \"float illuminance\" 5")
              .L.g *
          pi_f,
      5, 1e-5);
}

TEST(LoadLightTest, ReadsPictureEnvironments) {
  const std::string name = TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/good.pfm";
  const std::string light = "LightSource \"infinite\" \"string filename\" \"" + name + "\"";
  const auto plain = light_of<ImageEnvironment>(light);
  EXPECT_EQ(plain.resolution, 2);
  const auto bright = light_of<ImageEnvironment>(light + " \"float scale\" 3");
  EXPECT_EQ(bright.pixels[1], plain.pixels[1] * 3);
}

// All colors but rgb are scaled to luminance one, as pbrt-v4 does.
TEST(LoadLightTest, SpectraLoseTheirMagnitude) {
  for (const std::string spectrum : {"\"spectrum I\" [300 5 900 5]", "\"blackbody I\" 5000",
                                     "\"spectrum I\" \"stdillum-D50\""})
    EXPECT_NEAR(luminance(light_of<PointLight>("LightSource \"point\" " + spectrum).I), 1,
                0.01)
        << spectrum;
}

TEST(LoadLightTest, ColorsAreOfTheirColorSpace) {
  const auto light = light_of<PointLight>(
      "ColorSpace \"rec2020\" LightSource \"point\" \"rgb I\" [0.6274 0.0691 0.0164]");
  EXPECT_NEAR(light.I.r, 1, 1e-3);
  EXPECT_NEAR(light.I.g, 0, 1e-3);
  EXPECT_NEAR(light.I.b, 0, 1e-3);
}

}  // namespace
}  // namespace tyndall
