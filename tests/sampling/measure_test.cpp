// SPDX-License-Identifier: Apache-2.0
#include "tyndall/sampling/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tyndall/sampling/mis.h"

namespace tyndall {
namespace {

TEST(Measure, SphereOfAreaLightFillsAllDirections) {
  // Uniform on a sphere of radius 3 around the observer is uniform over directions.
  const float pdf_area = 1 / (4 * pi * 9);
  EXPECT_FLOAT_EQ(solid_angle_from_area(pdf_area, 9, 1), inv_4pi);
}

TEST(Measure, ConversionsAreInverse) {
  const float pdf = solid_angle_from_area(0.37f, 5.5f, 0.21f);
  EXPECT_FLOAT_EQ(area_from_solid_angle(pdf, 5.5f, 0.21f), 0.37f);
  EXPECT_TRUE(std::isinf(solid_angle_from_area(1, 1, 0)));
}

TEST(Mis, WeightsOfTwoTechniquesSumToOne) {
  for (const float a : {1e-30f, 1e-3f, 1.0f, 7.0f, 1e30f})
    for (const float b : {0.0f, 1e-30f, 0.5f, 7.0f, 1e30f, infinity}) {
      EXPECT_FLOAT_EQ(balance_heuristic(a, b) + balance_heuristic(b, a), 1)
          << a << " " << b;
      EXPECT_FLOAT_EQ(power_heuristic(a, b) + power_heuristic(b, a), 1) << a << " " << b;
    }
}

TEST(Mis, MatchesTheDefinition) {
  EXPECT_FLOAT_EQ(balance_heuristic(3, 1), 0.75f);
  EXPECT_FLOAT_EQ(power_heuristic(3, 1), 0.9f);
}

TEST(Mis, HasLimits) {
  EXPECT_EQ(power_heuristic(0, 0), 0);
  EXPECT_EQ(power_heuristic(0, 2), 0);
  EXPECT_EQ(power_heuristic(infinity, 2), 1);
  EXPECT_EQ(power_heuristic(2, infinity), 0);
  EXPECT_EQ(power_heuristic(infinity, infinity), 0.5f);
  EXPECT_EQ(balance_heuristic(infinity, infinity), 0.5f);
}

}  // namespace
}  // namespace tyndall
