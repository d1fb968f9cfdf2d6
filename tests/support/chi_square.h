// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "support/statistical_tests.h"
#include "tyndall/math/statistics.h"
#include "tyndall/math/vec.h"

namespace tyndall {

/// How well the samples of a distribution fit its density.
///
/// It proves only that the two agree, not that either is right: test a signed moment as
/// well. A test is worth nothing without all of
///   EXPECT_GT(r.p_value, sidak(0.01, tests)) << r;
///   EXPECT_NEAR(r.mass, expected mass, 1e-4);
///   EXPECT_EQ(r.samples_of_zero_pdf, 0);
struct ChiSquareResult {
  double p_value = 0;  ///< NaN if there are too few cells to test anything
  double statistic = 0;
  int degrees_of_freedom = 0;  ///< after pooling cells to an expectation of at least five
  double mass = 0;             ///< integral of the density over the domain
  int64_t samples_of_zero_pdf = 0;  ///< samples where the density is zero or not finite
  int64_t samples_in_empty_cells =
      0;                ///< in cells over which the density integrates to zero
  int64_t missing = 0;  ///< empty samples, and samples out of the domain
  std::vector<RunningMoments> moments;  ///< of each coordinate of the samples in the domain
  std::string worst_cells;              ///< where samples and density disagree most
};

std::ostream& operator<<(std::ostream& out, const ChiSquareResult& result);

/// The cells that chi_square_sphere() counts in: rings around a pole, cut into sectors.
struct SphereCells {
  int rings = 32, sectors = 64;
  Vec3 pole{0, 0, 1};  ///< unit
  /// How strongly the rings crowd to the pole: the first one covers about the share
  /// exp(-concentration) of the sphere. Put the pole on a peak and choose 10 or more for
  /// it.
  double concentration = 0;
};

// In all three the samples are drawn with independent uniform numbers. An empty sample is
// legitimate: the probability of all empty samples together must be one minus the mass.

/// Directions; `pdf` is w.r.t. solid angle.
ChiSquareResult chi_square_sphere(const std::function<std::optional<Vec3>(Vec2)>& sample,
                                  const std::function<double(Vec3)>& pdf,
                                  int64_t n = 200'000, uint64_t seed = 1,
                                  const SphereCells& cells = {});

/// Numbers in [min, max].
ChiSquareResult chi_square_line(const std::function<std::optional<float>(float)>& sample,
                                const std::function<double(double)>& pdf, double min,
                                double max, int64_t n = 200'000, uint64_t seed = 1,
                                int cells = 128);

/// Points in [0, 1]^2.
ChiSquareResult chi_square_square(const std::function<std::optional<Vec2>(Vec2)>& sample,
                                  const std::function<double(Vec2)>& pdf,
                                  int64_t n = 200'000, uint64_t seed = 1,
                                  int cells_per_side = 32);

}  // namespace tyndall
