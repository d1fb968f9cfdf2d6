// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/light_clusters.h"

#include <gtest/gtest.h>

#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

using Lights = std::vector<ClusterableLight>;

TEST(LightClustersTest, EveryLightIsItsOwnWhileThereIsRoom) {
  const Lights lights{{{0, 0, 0}, 1}, {{5, 0, 0}, 2}, {{0, 0, 0}, 3, true}, {{0, 7, 0}, 4}};
  const LightClusters c = cluster_lights(lights, 8);
  ASSERT_EQ(c.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(c.power[c.cluster_of[i]], lights[i].power);
    EXPECT_EQ(c.is_infinite[c.cluster_of[i]], lights[i].is_infinite);
  }
}

TEST(LightClustersTest, NeighboursStayTogether) {
  Lights lights;
  RandomStream random(1);
  for (int i = 0; i < 300; ++i)
    lights.push_back(
        {Vec3{100.0f * static_cast<float>(i % 3), random.next_1d(), random.next_1d()},
         0.5f + random.next_1d()});
  const LightClusters c = cluster_lights(lights, 3);
  ASSERT_EQ(c.size(), 3u);
  float power = 0;
  for (size_t i = 0; i < lights.size(); ++i) {
    EXPECT_EQ(c.cluster_of[i], c.cluster_of[i % 3]);
    power += lights[i].power;
  }
  EXPECT_NEAR(c.power[0] + c.power[1] + c.power[2], power, 1e-2f);
}

TEST(LightClustersTest, NeverMoreThanAskedFor) {
  Lights lights;
  RandomStream random(2);
  for (int i = 0; i < 200; ++i)
    lights.push_back(
        {{random.next_1d(), random.next_1d(), random.next_1d()}, 1, i % 4 == 0});
  for (const size_t most : {2u, 3u, 32u, 60u}) {
    const LightClusters c = cluster_lights(lights, most);
    EXPECT_EQ(c.size(), most);
    for (size_t i = 0; i < lights.size(); ++i)
      EXPECT_EQ(c.is_infinite[c.cluster_of[i]], lights[i].is_infinite);
  }
}

TEST(LightClustersTest, DegenerateLightsAreHarmless) {
  EXPECT_EQ(cluster_lights({}, 4).size(), 0u);
  EXPECT_EQ(cluster_lights(Lights(10, {{1, 2, 3}, 1}), 4).size(), 1u);
  EXPECT_EQ(cluster_lights(Lights(5, {{1, 2, 3}, 1, true}), 2).size(), 2u);
  const Lights dark{{{0, 0, 0}, 0}, {{1e6f, 0, 0}, 0}, {{0, -1e30f, 0}, 0}};
  EXPECT_LE(cluster_lights(dark, 4).size(), 3u);
}

}  // namespace
}  // namespace tyndall
