// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/tail.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace tyndall {
namespace {

constexpr float passing = 0.25f;  // the fog before the surface that the camera sees

class TailTest : public testing::Test {
 protected:
  TailTest() : scene_(room()), context_(scene_, {.single = true, .lit_surfaces = 4}) {}

  // A lamp over a floor in fog.
  static SceneDescription room() {
    SceneDescription d;
    d.camera = test::camera({0, 0, -1}, {0, 0, 1});
    d.media.push_back(test::grey_fog(0.3f, 0));
    d.camera_medium = 0;
    d.surfaces.push_back(test::diffuse_disk(1, 2, 0.5f));
    d.lights.push_back(Light(PointLight{{}, Rgb(1)}));
    return d;
  }
  TailDensities densities(int vertices, const LitChain& chain, float probability) const {
    const ConnectionCounts once;
    const LightEnd end{.light = 0,
                       .probability = 1,
                       .pdf = 1,
                       .pdf_direction = 0.1f,
                       .to_light = {0, 0, -1},
                       .distance = 1};
    return surface_tail_densities(context_, {&once, vertices, probability}, chain,
                                  {0, 0, 1}, end, 1);
  }

  Scene scene_;
  ConnectionContext context_;
};

// A walk passes the fog before that surface with a probability; connections from it are
// made for certain, whatever comes after.
TEST_F(TailTest, WalksCountAsOftenAsTheyReachWhatTheCameraSees) {
  for (int edges = 1; edges <= 2; ++edges) {
    LitChain chain;
    for (int i = 0; i < edges; ++i) chain.push_back(0.2f);
    const TailDensities certain = densities(edges + 1, chain, 1);
    const TailDensities rare = densities(edges + 1, chain, passing);
    ASSERT_GT(certain.lit[edges - 1], 0);
    EXPECT_FLOAT_EQ(rare.direct, passing * certain.direct);
    EXPECT_FLOAT_EQ(rare.hit, passing * certain.hit);
    for (int i = 0; i < edges - 1; ++i)
      EXPECT_FLOAT_EQ(rare.lit[i], passing * certain.lit[i]);
    EXPECT_FLOAT_EQ(rare.lit[edges - 1], certain.lit[edges - 1]);
  }
}

// All techniques walk to where the chain begins.
TEST_F(TailTest, LaterSurfacesAreReachedAlike) {
  LitChain chain;
  chain.push_back(0.2f);
  EXPECT_FLOAT_EQ(densities(3, chain, passing).direct, densities(3, chain, 1).direct);
  chain.is_seen_from_leg = true;
  EXPECT_FLOAT_EQ(densities(2, chain, passing).direct, densities(2, chain, 1).direct);
}

}  // namespace
}  // namespace tyndall
