// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/loader/color_space.h"
#include "tyndall/loader/named_spectra.h"
#include "tyndall/loader/spectrum.h"

namespace tyndall::loader {
namespace {

void expect_near(Rgb actual, Rgb expected, float tolerance) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(actual[i], expected[i], tolerance) << "channel " << i;
}

TEST(ColorSpaceTest, KeepsGreyExactly) {
  for (const ColorSpace space :
       {ColorSpace::srgb, ColorSpace::dci_p3, ColorSpace::rec2020, ColorSpace::aces2065_1})
    EXPECT_EQ(rec709_from(space, Rgb(0.3f)), Rgb(0.3f));
}

// The primaries of Rec. 709 in the other spaces, from the definitions of those spaces.
TEST(ColorSpaceTest, FindsTheRec709Primaries) {
  expect_near(rec709_from(ColorSpace::rec2020, {0.6274039f, 0.0690973f, 0.0163914f}),
              {1, 0, 0}, 1e-5f);
  expect_near(rec709_from(ColorSpace::dci_p3, {0.1775380f, 0.9668058f, 0.0723974f}),
              {0, 1, 0}, 1e-5f);
  expect_near(rec709_from(ColorSpace::aces2065_1, {0.4396330f, 0.0897764f, 0.0175412f}),
              {1, 0, 0}, 1e-4f);
}

TEST(ColorSpaceTest, MapsD65ToWhite) {
  expect_near(rec709_from_xyz(0.950456f, 1, 1.089058f), Rgb(1), 2e-4f);
}

TEST(SpectrumTest, ConstantsAreGreyUnderDaylight) {
  expect_near(rgb_under_daylight([](float) { return 0.25f; }), Rgb(0.25f), 1e-6f);
}

TEST(SpectrumTest, ColorsFollowTheWavelength) {
  const auto band = [](float low, float high) {
    return rgb_under_daylight([=](float w) { return low <= w && w < high ? 1.0f : 0.0f; });
  };
  const Rgb red = band(600, 700), green = band(510, 570), blue = band(420, 480);
  EXPECT_GT(red.r, 2 * std::max(red.g, red.b));
  EXPECT_GT(green.g, 2 * std::max(green.r, green.b));
  EXPECT_GT(blue.b, 2 * std::max(blue.r, blue.g));
}

TEST(SpectrumTest, LightsHaveLuminanceOne) {
  for (const float temperature : {3500.0f, 5000.0f, 6500.0f, 15000.0f})
    EXPECT_NEAR(luminance(rgb_of_light(blackbody(temperature))), 1, 0.01) << temperature;
  EXPECT_EQ(rgb_of_light([](float) { return 0.0f; }), Rgb{});
}

// Chromaticities of the Planckian locus, tabulated to four digits in colorimetry textbooks:
// 3000 K is (0.4369, 0.4041), 6500 K (0.3135, 0.3237), 10000 K (0.2807, 0.2884).
TEST(SpectrumTest, BlackbodiesHaveTheirColor) {
  const auto color = [](float x, float y) {
    return rec709_from_xyz(x / y, 1, (1 - x - y) / y);
  };
  expect_near(rgb_of_light(blackbody(3000)), color(0.4369f, 0.4041f), 0.03f);
  expect_near(rgb_of_light(blackbody(6500)), color(0.3135f, 0.3237f), 0.03f);
  expect_near(rgb_of_light(blackbody(10000)), color(0.2807f, 0.2884f), 0.03f);
}

// Wien's displacement law: the maximum is at 2.898e6 nm K / T.
TEST(SpectrumTest, BlackbodiesPeakAtOne) {
  const SpectrumFunction spectrum = blackbody(5000);
  const float peak = 2.897771955e6f / 5000;
  EXPECT_NEAR(spectrum(peak), 1, 1e-5);
  EXPECT_LT(spectrum(peak * 0.98f), 1);
  EXPECT_LT(spectrum(peak * 1.02f), 1);
}

TEST(SpectrumTest, InterpolatesBetweenPoints) {
  const PiecewiseLinearSpectrum spectrum{{400, 500, 700}, {1, 3, 2}};
  EXPECT_EQ(spectrum(300), 1);
  EXPECT_EQ(spectrum(400), 1);
  EXPECT_EQ(spectrum(450), 2);
  EXPECT_EQ(spectrum(600), 2.5f);
  EXPECT_EQ(spectrum(700), 2);
  EXPECT_EQ(spectrum(900), 2);
}

// Reflectance of a metal at normal incidence.
float reflectance(float eta, float k) {
  return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

Rgb reflectance(std::string_view metal) {
  const Rgb eta = *named_spectrum("metal-" + std::string(metal) + "-eta");
  const Rgb k = *named_spectrum("metal-" + std::string(metal) + "-k");
  return {reflectance(eta.r, k.r), reflectance(eta.g, k.g), reflectance(eta.b, k.b)};
}

// Linear sRGB of D65 reflected at normal incidence, from the spectra of [Luxpop26], brass of
// [Querry85], and the CIE's observer in steps of 1 nm; gold is beyond the gamut in red.
TEST(NamedSpectraTest, MetalsHaveTheirColors) {
  expect_near(reflectance("Ag"), {0.9715f, 0.9599f, 0.9153f}, 5e-4f);
  expect_near(reflectance("Al"), {0.9132f, 0.9215f, 0.9245f}, 5e-4f);
  expect_near(reflectance("Au"), {0.99f, 0.7824f, 0.3434f}, 5e-4f);
  expect_near(reflectance("Cu"), {0.9553f, 0.6376f, 0.5382f}, 5e-4f);
  expect_near(reflectance("MgO"), {0.0720f, 0.0731f, 0.0749f}, 5e-4f);
  expect_near(reflectance("TiO2"), {0.2322f, 0.2446f, 0.2727f}, 5e-4f);
  expect_near(reflectance("CuZn"), {0.9097f, 0.7781f, 0.4231f}, 5e-4f);
}

TEST(NamedSpectraTest, KnowsIlluminantsAndGlasses) {
  expect_near(*named_spectrum("stdillum-D65"), Rgb(1), 1e-3f);
  EXPECT_GT(named_spectrum("stdillum-A")->r, named_spectrum("stdillum-A")->b + 1);
  EXPECT_EQ(*named_spectrum("glass-BK7"), Rgb(1.5168f));
  EXPECT_EQ(*named_spectrum("glass-F10"), *named_spectrum("glass-SF10"));
  EXPECT_FALSE(named_spectrum("glass-BK8"));
}

}  // namespace
}  // namespace tyndall::loader
