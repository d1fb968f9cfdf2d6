// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "parse.h"

namespace tyndall {
namespace {

Material material_of(const std::string& world) {
  return test::surface_of(world + " Shape \"sphere\"").material;
}

template <typename T>
T material_of(const std::string& world) {
  return std::get<T>(material_of(world));
}

Rgb reflectance_of(const std::string& world) {
  return material_of<DiffuseBsdf>(world).reflectance;
}

void expect_near(Rgb actual, Rgb expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-5) << i;
}

TEST(LoadMaterialTest, ReadsDiffuse) {
  EXPECT_EQ(reflectance_of(""), Rgb(0.5f));
  EXPECT_EQ(reflectance_of("Material \"diffuse\""), Rgb(0.5f));
  EXPECT_EQ(reflectance_of("Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3]"),
            (Rgb{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(reflectance_of("Material \"diffuse\" \"spectrum reflectance\" [360 .7 830 .7]"),
            Rgb(0.7f));
}

TEST(LoadMaterialTest, RoughnessBecomesAlpha) {
  const auto metal = material_of<ConductorBsdf>(
      "Material \"conductor\" \"float uroughness\" .25 \"float vroughness\" .04");
  EXPECT_FLOAT_EQ(metal.alpha_x, 0.5f);
  EXPECT_FLOAT_EQ(metal.alpha_y, 0.2f);
  const auto plain = material_of<DielectricBsdf>(
      "Material \"dielectric\" \"float roughness\" .25 \"bool remaproughness\" false");
  EXPECT_EQ(plain.alpha_x, 0.25f);
  EXPECT_EQ(plain.alpha_y, 0.25f);
  const auto smooth = material_of<DielectricBsdf>(
      "Material \"dielectric\" \"float roughness\" 1e-4 \"bool remaproughness\" false");
  EXPECT_EQ(smooth.alpha_x, 0);
}

TEST(LoadMaterialTest, MetalsAreCopperUnlessTheySay) {
  const auto copper = material_of<ConductorBsdf>("Material \"conductor\"");
  const auto named = material_of<ConductorBsdf>(
      "Material \"conductor\" \"spectrum eta\" \"metal-Cu-eta\" \"spectrum k\" "
      "\"metal-Cu-k\"");
  EXPECT_EQ(copper.eta, named.eta);
  EXPECT_EQ(copper.k, named.k);
  const auto silver =
      material_of<ConductorBsdf>("Material \"conductor\" \"spectrum k\" \"metal-Ag-k\"");
  EXPECT_EQ(silver.eta, copper.eta);
  EXPECT_NE(silver.k, copper.k);
}

// ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2) at normal incidence.
TEST(LoadMaterialTest, MetalsReflectWhatIsAskedFor) {
  const auto metal =
      material_of<ConductorBsdf>("Material \"conductor\" \"rgb reflectance\" [.2 .5 .9]");
  const Rgb k2 = metal.k * metal.k;
  EXPECT_EQ(metal.eta, Rgb(1));
  expect_near(safe_divide(k2, k2 + Rgb(4)), {0.2f, 0.5f, 0.9f});
}

TEST(LoadMaterialTest, ReadsGlass) {
  EXPECT_EQ(material_of<DielectricBsdf>("Material \"dielectric\"").eta, 1.5f);
  EXPECT_EQ(material_of<DielectricBsdf>("Material \"dielectric\" \"float eta\" 1.3").eta,
            1.3f);
  EXPECT_EQ(
      material_of<DielectricBsdf>("Material \"dielectric\" \"spectrum eta\" \"glass-SF11\"")
          .eta,
      1.7847f);
}

TEST(LoadMaterialTest, ThreeNamesForInterface) {
  for (const std::string name : {"interface", "", "none"})
    EXPECT_TRUE(
        std::holds_alternative<InterfaceBsdf>(material_of("Material \"" + name + "\"")));
}

TEST(LoadMaterialTest, NamesMayBeUsedBeforeTheirDefinition) {
  const LoadedScene loaded = test::parse_world(
      "NamedMaterial \"a\" Shape \"sphere\" "
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"rgb reflectance\" [.1 .2 .3]");
  EXPECT_EQ(std::get<DiffuseBsdf>(loaded.scene.surfaces[0].material).reflectance,
            (Rgb{0.1f, 0.2f, 0.3f}));
}

TEST(LoadMaterialTest, MixesDiffuseMaterials) {
  const std::string two =
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"rgb reflectance\" [0 0 0] "
      "MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 1 1] ";
  expect_near(reflectance_of(two + "Material \"mix\" \"string materials\" [\"a\" \"b\"] "
                                   "\"float amount\" .25"),
              Rgb(0.25f));
}

std::string textured(const std::string& texture) {
  return "Texture \"t\" \"spectrum\" " + texture +
         " Material \"diffuse\" \"texture reflectance\" \"t\"";
}

TEST(LoadTextureTest, EvaluatesConstants) {
  expect_near(reflectance_of(textured("\"constant\" \"rgb value\" [.1 .2 .3]")),
              {0.1f, 0.2f, 0.3f});
  expect_near(
      reflectance_of("Texture \"s\" \"spectrum\" \"constant\" \"rgb value\" [1 .5 0] " +
                     textured("\"scale\" \"texture tex\" \"s\" \"float scale\" .5")),
      {0.5f, 0.25f, 0});
  expect_near(reflectance_of("Texture \"a\" \"float\" \"constant\" \"float value\" .25 " +
                             textured("\"mix\" \"rgb tex1\" [0 0 0] \"rgb tex2\" [1 1 0] "
                                      "\"texture amount\" \"a\"")),
              {0.25f, 0.25f, 0});
}

TEST(LoadTextureTest, TakesTheMeanOfWhatVaries) {
  expect_near(reflectance_of(
                  textured("\"checkerboard\" \"rgb tex1\" [.2 .4 0] \"rgb tex2\" [.4 .8 0] "
                           "\"float uscale\" 8")),
              {0.3f, 0.6f, 0});
  expect_near(reflectance_of(textured("\"marble\"")), Rgb(0.5f));
  const std::string picture = TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/good.pfm";
  const Rgb mean = reflectance_of(
      textured("\"imagemap\" \"float scale\" .1 \"string filename\" \"" + picture + "\""));
  expect_near(mean, {0.45f, 0.55f, 0.65f});  // of 0..11 in pixels of three
}

TEST(LoadTextureTest, TexturesOfBothKindsMayShareAName) {
  expect_near(reflectance_of("Texture \"t\" \"float\" \"constant\" \"float value\" .9 " +
                             textured("\"constant\" \"rgb value\" [.1 .1 .1]")),
              Rgb(0.1f));
}

}  // namespace
}  // namespace tyndall
