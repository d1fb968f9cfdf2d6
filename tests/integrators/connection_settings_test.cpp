// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/connection_settings.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace tyndall {
namespace {

std::string message_of(const std::string& integrator, const std::string& option,
                       const std::string& value) {
  try {
    connection_settings(integrator, {{option, value}});
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "no exception";
}

TEST(ConnectionSettingsTest, EverySwitchOfLearnedTurnsItsPartOff) {
  const ConnectionSettings all = connection_settings("learned", {});
  EXPECT_TRUE(all.direction && all.visibility && all.lit_surfaces && all.product);
  const auto without = [](const char* name) {
    return connection_settings("learned", {{name, "off"}});
  };
  EXPECT_FALSE(without("learned.direction").direction);
  EXPECT_FALSE(without("learned.distance").visibility);
  EXPECT_FALSE(without("learned.lit_surfaces").lit_surfaces);
  EXPECT_FALSE(without("learned.roulette").roulette);
  EXPECT_FALSE(without("learned.sky").sky_directions);
  EXPECT_FALSE(without("learned.product").product);
  EXPECT_FALSE(without("learned.pretraining").pretraining);
  EXPECT_TRUE(without("learned.product").direction);
}

TEST(ConnectionSettingsTest, Zhou2016LearnsDirectionsOnly) {
  const ConnectionSettings s = connection_settings("zhou2016", {});
  EXPECT_TRUE(s.single && s.dual && s.direction);
  EXPECT_FALSE(s.visibility || s.lit_surfaces);
}

TEST(ConnectionSettingsTest, UnknownOptionNamesTheNearest) {
  EXPECT_EQ(message_of("learned", "learned.directon", "off"),
            "integrator \"learned\" has no option \"learned.directon\"; did you mean "
            "\"learned.direction\"?");
  for (const char* name : {"direction", "zhou2016.direction", "learned.directions"})
    EXPECT_EQ(message_of("learned", name, "off"),
              "integrator \"learned\" has no option \"" + std::string(name) +
                  "\"; did you mean \"learned.direction\"?");
  EXPECT_EQ(message_of("zhou2016", "zhou2016.product", "off"),
            "integrator \"zhou2016\" has no option \"zhou2016.product\"; did you mean "
            "\"learned.product\"?");
  EXPECT_EQ(message_of("jis", "learned.particles", "off"),
            "integrator \"jis\" has no option \"learned.particles\"; did you mean "
            "\"particles\"?");
}

TEST(ConnectionSettingsTest, OptionsOfOtherIntegratorsNameThem) {
  EXPECT_EQ(message_of("zhou2016", "learned.direction", "off"),
            "integrator \"zhou2016\" has no option \"learned.direction\"; it belongs to "
            "\"learned\"");
  EXPECT_EQ(message_of("volpath", "learned.product", "off"),
            "integrator \"volpath\" has no option \"learned.product\"; it belongs to "
            "\"learned\", \"zhou2016\"");
}

TEST(ConnectionSettingsTest, NamesLikeNoOtherListAll) {
  for (const char* name : {"learned.foo", "learned.visibility", "learned.", "learned", ""})
    EXPECT_EQ(message_of("learned", name, "off"),
              "integrator \"learned\" has no option \"" + std::string(name) +
                  "\"; there are: learned.direction, learned.distance, "
                  "learned.lit_surfaces, learned.memory, learned.pretraining, "
                  "learned.product, learned.roulette, learned.sky, particles");
  EXPECT_EQ(message_of("volpath", "direction", "off"),
            "integrator \"volpath\" has no option \"direction\"; there are: particles");
}

TEST(ConnectionSettingsTest, SwitchesAreOnOrOff) {
  EXPECT_EQ(message_of("learned", "learned.direction", "maybe"),
            "option \"learned.direction\" is \"on\" or \"off\", not \"maybe\"");
}

TEST(ConnectionSettingsTest, MemoryIsAPositiveNumberOfMegabytes) {
  EXPECT_EQ(connection_settings("learned", {}).direction_memory, 128'000'000u);
  for (const char* integrator : {"learned", "zhou2016"}) {
    const auto with = [&](const char* text) {
      return connection_settings(integrator, {{"learned.memory", text}}).direction_memory;
    };
    EXPECT_EQ(with("64"), 64'000'000u);
    EXPECT_EQ(with("1e3"), 1'000'000'000u);
    EXPECT_EQ(with("0.5"), 500'000u);
    for (const std::string text : {"0", "-1", "nan", "inf", "1e99", "", "8MB", "on", " 1"})
      EXPECT_EQ(
          message_of(integrator, "learned.memory", text),
          "option \"learned.memory\" is a positive number of MB, not \"" + text + "\"");
  }
}

TEST(ConnectionSettingsTest, UnknownIntegratorNamesTheKnownOnes) {
  EXPECT_EQ(message_of("learnt", "a", "b"),
            "unknown integrator \"learnt\"; there are: volpath, equiangular, jis, learned, "
            "zhou2016");
}

}  // namespace
}  // namespace tyndall
