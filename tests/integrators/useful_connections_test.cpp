// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/useful_connections.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace tyndall {
namespace {

// A ball of fog, the camera outside, and a light at that distance.
SceneDescription ball_and_light(float distance) {
  SceneDescription d;
  d.camera = test::camera({0, 0, -3}, {0, 0, 0});
  d.media.push_back(test::grey_fog(1, 0, 0.3f));
  d.surfaces.push_back(test::boundary_sphere(1));
  d.lights.push_back(Light(PointLight{{distance, 0, 0}, Rgb(distance * distance)}));
  return d;
}

ConnectionSettings useful(SceneDescription description) {
  return useful_connections(Scene(std::move(description)),
                            connection_settings("learned", {}))
      .settings;
}

std::string why_unlearned(SceneDescription description, const char* integrator = "learned",
                          std::map<std::string, std::string> options = {}) {
  return useful_connections(Scene(std::move(description)),
                            connection_settings(integrator, options))
      .why_unlearned;
}

TEST(UsefulConnectionsTest, NearLightsKeepTheirConnections) {
  const ConnectionSettings s = useful(ball_and_light(2));
  EXPECT_TRUE(s.single && s.dual);
  // Nothing hides the light, nothing reflects it.
  EXPECT_FALSE(s.visibility || s.direction || s.lit_surfaces);
  EXPECT_EQ(s.min_distance_ratio, ConnectionSettings().min_distance_ratio);
}

TEST(UsefulConnectionsTest, OccludersAreAReasonToLearnThemForFarLightsToo) {
  for (const float distance : {2.0f, 100.0f}) {
    SceneDescription d = ball_and_light(distance);
    d.lights = {Light(PointLight{{0, 0, distance}, Rgb(distance * distance)})};
    d.surfaces.push_back(test::diffuse_disk(0.5f, 0.5f, 0.5f));
    const ConnectionSettings s = useful(std::move(d));
    EXPECT_TRUE(s.single && s.dual && s.direction && s.visibility && s.lit_surfaces);
    EXPECT_EQ(s.min_distance_ratio, 1);
  }
}

TEST(UsefulConnectionsTest, SaysWhyNothingIsLearned) {
  const std::string reason =
      " learned: surfaces hide 0 % of the light from what the picture shows, and below "
      "30 % learning gains less than it costs";
  EXPECT_EQ(why_unlearned(ball_and_light(2)),
            "neither distances nor directions were" + reason);
  EXPECT_EQ(why_unlearned(ball_and_light(2), "zhou2016"), "no directions were" + reason);
  EXPECT_EQ(why_unlearned(ball_and_light(2), "learned", {{"learned.direction", "off"}}),
            "no distances were" + reason);
  EXPECT_EQ(why_unlearned(ball_and_light(2), "jis"), "");
  SceneDescription clear = ball_and_light(2);
  clear.surfaces.clear();
  EXPECT_EQ(why_unlearned(std::move(clear)),
            "neither distances nor directions were learned: camera paths meet neither fog "
            "nor smoke");
  // Directions are learned here.
  SceneDescription smoke = ball_and_light(2);
  smoke.surfaces.push_back(test::diffuse_disk(2, 0.5f, 0.5f));
  EXPECT_EQ(why_unlearned(std::move(smoke)), "");
}

// What surfaces see of smoke, directions are learned for, not of fog on all sides.
TEST(UsefulConnectionsTest, SmokeThatSurfacesSeeIsAReasonToLearnDirections) {
  for (const bool is_fog : {false, true}) {
    SceneDescription d = ball_and_light(2);
    d.surfaces.push_back(test::diffuse_disk(2, 0.5f, 0.5f));
    if (is_fog) {
      d.surfaces.erase(d.surfaces.begin());
      d.camera_medium = 0;
    }
    const ConnectionSettings s = useful(std::move(d));
    EXPECT_FALSE(s.visibility);
    EXPECT_EQ(s.direction, !is_fog);
  }
}

TEST(UsefulConnectionsTest, FarLightsThatNothingHidesNeedNone) {
  EXPECT_FALSE(useful(ball_and_light(100)).single);
  SceneDescription unbounded = ball_and_light(100);
  unbounded.camera_medium = 0;
  EXPECT_TRUE(useful(std::move(unbounded)).single);
  SceneDescription sky_only = ball_and_light(2);
  sky_only.lights = {Light(ConstantEnvironment{Rgb(1)})};
  EXPECT_FALSE(useful(std::move(sky_only)).single);
}

TEST(UsefulConnectionsTest, SkiesThatSomethingHidesAreForeseen) {
  SceneDescription d = ball_and_light(2);
  d.lights = {Light(DistantLight{{0, 0, 1}, Rgb(1)})};
  d.surfaces.push_back(test::diffuse_disk(0.5f, 0.5f, 0.5f));
  const ConnectionSettings s = useful(std::move(d));
  EXPECT_TRUE(s.single && s.visibility && s.lit_surfaces);
}

TEST(UsefulConnectionsTest, WithoutThemLearnedIsVolpathAndSaysSo) {
  const Scene scene(ball_and_light(100));
  const auto rendered = [&](const char* integrator) {
    RenderSettings s = test::settings(integrator, 5);
    s.resolution = s.crop_max = {16, 16};
    return render(scene, s);
  };
  const RenderResult learned = rendered("learned"), volpath = rendered("volpath");
  EXPECT_EQ(learned.film.develop().find("G")->values,
            volpath.film.develop().find("G")->values);
  EXPECT_EQ(
      learned.statistics.notes,
      std::vector<std::string>{
          "no light is near enough to what scatters for connections to help: rendered "
          "as by \"volpath\", and nothing was learned"});
  EXPECT_TRUE(volpath.statistics.notes.empty());
}

}  // namespace
}  // namespace tyndall
