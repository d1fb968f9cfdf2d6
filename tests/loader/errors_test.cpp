// SPDX-License-Identifier: Apache-2.0
// How errors and warnings come out. What they say is asserted by the corpus in tests/fuzz.
#include <gtest/gtest.h>

#include <ctime>

#include "parse.h"

namespace tyndall {
namespace {

TEST(LoadErrorsTest, NamesThePlaceAndTheRange) {
  EXPECT_EQ(test::error_of("Camera \"perspective\"\n"
                           "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
                           "  \"rgb sigma_s\" [ .5 .5 .5 ] \"float g\" 1.2\n"
                           "WorldBegin\nLightSource \"infinite\"\n"),
            "test.pbrt:3:30: error: MakeNamedMedium \"fog\": parameter \"g\" must lie in "
            "(-1, 1), "
            "got 1.2\n"
            "    3 |   \"rgb sigma_s\" [ .5 .5 .5 ] \"float g\" 1.2\n"
            "      |                              ^~~~~~~~~~~~~");
}

// Densities of directions end where the phase function is a Dirac delta.
TEST(LoadErrorsTest, RefusesPhaseFunctionsThatDoNotSpread) {
  for (const std::string g : {"1", "-1"})
    EXPECT_EQ(test::error_of("Camera \"perspective\"\n"
                             "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
                             "  \"float g\" " +
                             g + "\nWorldBegin\nLightSource \"infinite\"\n"),
              "test.pbrt:3:3: error: MakeNamedMedium \"fog\": parameter \"g\" must lie in "
              "(-1, 1), got " +
                  g + "\n    3 |   \"float g\" " + g + "\n      |   ^~~~~~~~~~" +
                  std::string(g.size(), '~'));
}

TEST(LoadErrorsTest, UsesOfWhatIsBrokenAreNoErrorsOfTheirOwn) {
  EXPECT_EQ(test::error_of("Camera \"perspective\" WorldBegin LightSource \"infinite\"\n"
                           "MakeNamedMedium \"m\" \"float g\" [ 1 /\n"
                           "MediumInterface \"m\" \"\" Shape \"sphere\"\n"
                           "MakeNamedMaterial \"w\" \"float eta\" \"x\"\n"
                           "NamedMaterial \"w\" Shape \"sphere\"\n"),
            "test.pbrt:2:35: error: expected a number for \"float g\", got \"/\"\n"
            "    2 | MakeNamedMedium \"m\" \"float g\" [ 1 /\n"
            "      |                                   ^\n"
            "test.pbrt:4:35: error: expected a number for \"float eta\", got a string\n"
            "    4 | MakeNamedMaterial \"w\" \"float eta\" \"x\"\n"
            "      |                                   ^~~");
}

TEST(LoadErrorsTest, KeepsTheDiagnosticsApart) {
  try {
    test::parse_world("Shape \"sphere\" \"float radius\" -1\nShape \"cube\"\n");
    FAIL();
  } catch (const SceneError& error) {
    ASSERT_EQ(error.diagnostics().size(), 2u);
    const Diagnostic& first = error.diagnostics()[0];
    EXPECT_EQ(first.severity, Severity::error);
    EXPECT_EQ(first.where.file, "test.pbrt");
    EXPECT_EQ(first.where.line, 5);
    EXPECT_EQ(first.where.column, 16);
    EXPECT_EQ(first.message,
              "Shape \"sphere\": parameter \"radius\" must be positive, got -1");
    EXPECT_EQ(error.what(), first.text + "\n" + error.diagnostics()[1].text);
  }
}

TEST(LoadErrorsTest, StopsAfterTwenty) {
  std::string world;
  for (int i = 0; i < 100; ++i) world += "Shape \"cube\"\n";
  try {
    test::parse_world(world);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(error.diagnostics().size(), 20u);
  }
}

TEST(LoadErrorsTest, WarningsReachTheSinkAndTheResult) {
  std::vector<std::string> heard;
  const LoadedScene loaded = parse_scene(
      "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\nShape \"cylinder\"\n",
      "test.pbrt", {.strict = false, .on_warning = [&](const Diagnostic& warning) {
                      heard.push_back(warning.text);
                    }});
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0],
            "test.pbrt:4:1: warning: Shape \"cylinder\": not supported yet, skipped\n"
            "    4 | Shape \"cylinder\"\n"
            "      | ^~~~~~~~~~~~~~~~");
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(loaded.warnings[0].severity, Severity::warning);
}

TEST(LoadErrorsTest, StrictMakesWhatIsNotSupportedAnError) {
  EXPECT_EQ(test::error_of("Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
                           "Shape \"cylinder\"\n",
                           {.strict = true, .on_warning = {}}),
            "test.pbrt:4:1: error: Shape \"cylinder\": not supported yet, skipped\n"
            "    4 | Shape \"cylinder\"\n"
            "      | ^~~~~~~~~~~~~~~~");
}

TEST(LoadErrorsTest, RepeatedWarningsFallSilent) {
  std::string world;
  for (int i = 0; i < 50; ++i) world += "Shape \"cylinder\"\n";
  const LoadedScene loaded = test::parse_world(world);
  ASSERT_EQ(loaded.warnings.size(), 10u);
  EXPECT_EQ(
      loaded.warnings[9].message,
      "Shape \"cylinder\": not supported yet, skipped (the last time that this is said)");
}

TEST(LoadErrorsTest, AFileThatCannotBeReadIsNoSceneError) {
  try {
    load_scene("no/such/scene.pbrt");
    FAIL();
  } catch (const SceneError&) {
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "cannot read \"no/such/scene.pbrt\": No such file or directory");
  }
}

// Loading time grows with the text, not with its square.
TEST(LoadErrorsTest, ManyDirectivesOnOneLine) {
  std::string world;
  for (int i = 0; i < 100000; ++i) world += "AttributeBegin Shape \"sphere\" AttributeEnd ";
  const std::clock_t start = std::clock();
  EXPECT_EQ(test::parse_world(world).scene.surfaces.size(), 100000u);
  EXPECT_LT(std::clock() - start,
            10 * CLOCKS_PER_SEC);  // a tenth of a second; a square: hours
}

}  // namespace
}  // namespace tyndall
