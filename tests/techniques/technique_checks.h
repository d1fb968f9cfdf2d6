// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <vector>

#include "tyndall/geometry/ray.h"
#include "tyndall/math/constants.h"
#include "tyndall/sampling/random.h"
#include "tyndall/techniques/samples.h"

namespace tyndall {

/// A ray along +z from the origin, a pivot in the x-z plane, and a stretch.
struct Geometry {
  const char* name;
  float h, foot;  ///< of the pivot: distance from the ray, and where
  float t_min, t_max;

  Ray ray() const { return {{0, 0, 0}, {0, 0, 1}}; }
  Vec3 pivot() const { return {h, 0, foot}; }
  double s(double t) const { return t - foot; }
  double r(double t) const { return std::hypot(s(t), double(h)); }
  /// Angle at the point t between the ray and the direction to the pivot.
  double alpha(double t) const { return std::atan2(double(h), -s(t)); }
};

inline std::ostream& operator<<(std::ostream& out, const Geometry& g) {
  return out << g.name;
}

/// Pivots beside, before and behind the stretch, near and far.
inline std::vector<Geometry> geometries() {
  return {{"beside", 1, 2, 0, 5},
          {"behind", 0.5f, -1, 0.25f, 4},
          {"ahead", 0.5f, 6, 0.25f, 4},
          {"short", 1, 2, 3, 3.001f},
          {"unbounded", 1, 2, 0, infinity},
          {"unbounded_behind", 0.1f, -3, 0, infinity},
          {"very_near", 1e-6f, 2, 0, 5},
          {"near_the_origin", 1e-6f, 1e-5f, 0, 5},
          {"near_the_line_behind", 1e-6f, -1, 0, 5},
          {"near_the_line_ahead", 1e-6f, 6, 0, 5},
          {"on_the_line_behind", 0, -1, 0, 5},
          {"on_the_line_ahead", 0, 6, 0, 5},
          {"far_beside", 1e6f, 2, 0, 5},
          {"far_ahead", 1e6f, 1e6f, 0, 5},
          {"far_behind", 1e3f, -1e6f, 0, 5},
          {"at_the_foot_end", 1, 5, 0, 5},
          {"long", 1, 1e5f, 0, 1e6f}};
}

/// The spacing of floats at x.
inline double ulp(double x) {
  const auto f = static_cast<float>(std::abs(x));
  return std::nextafter(f, infinity) - f;
}

/// How far a density per length may move because positions along the ray are floats:
/// relative.
inline double position_error(const Geometry& geometry, double t) {
  const double error = ulp(t) + ulp(geometry.s(t)) + ulp(geometry.s(geometry.t_min)) +
                       (geometry.t_max < infinity ? ulp(geometry.s(geometry.t_max)) : 0);
  return 3 * error / geometry.r(t);
}

/// Distances in the stretch: those that `technique` finds, and the ends.
template <typename Technique>
std::vector<float> distances(const Geometry& geometry, const Technique& technique) {
  std::vector<float> result{geometry.t_min};
  if (geometry.t_max < infinity) result.push_back(geometry.t_max);
  for (int i = 0; i < 200; ++i) {
    const auto sample = technique.sample((static_cast<float>(i) + 0.5f) / 200);
    EXPECT_TRUE(sample.has_value()) << i;
    if (sample) result.push_back(sample->t);
  }
  return result;
}

/// sample(), pdf_t() and invert() are those of the density and distribution function `cdf`,
/// which are given in double; `tolerance` is relative for the one and absolute for the
/// other.
template <typename Technique, typename Pdf, typename Cdf>
void expect_follows(const Geometry& geometry, const Technique& technique, const Pdf& pdf,
                    const Cdf& cdf, double tolerance) {
  for (const float t : distances(geometry, technique)) {
    const double expected = pdf(t);
    EXPECT_NEAR(technique.pdf_t(t) / expected, 1, tolerance + position_error(geometry, t))
        << "t = " << t;
    EXPECT_NEAR(technique.invert(t), cdf(t), tolerance + expected * ulp(t) * 8)
        << "t = " << t;
  }
}

/// t grows with u, the density of a sample is pdf_t(), and invert() leads back to u.
template <typename Technique>
void expect_round_trip(const Technique& technique, double tolerance) {
  RandomStream random(1);
  for (int i = 0; i < 2000; ++i) {
    const float u = random.next_1d();
    const auto sample = technique.sample(u);
    ASSERT_TRUE(sample.has_value()) << u;
    EXPECT_FLOAT_EQ(sample->pdf_t, technique.pdf_t(sample->t)) << u;
    EXPECT_NEAR(technique.invert(sample->t), u,
                tolerance + 8 * ulp(sample->t) * sample->pdf_t)
        << "t = " << sample->t;
  }
}

/// The density is the inverse of dt / du, by finite differences.
template <typename Technique>
void expect_inverse_jacobian(const Technique& technique, double tolerance) {
  for (float u = 0.01f; u < 0.99f; u += 0.0173f) {
    const double step = 1.0 / 512;
    const auto low = technique.sample(static_cast<float>(u - step));
    const auto middle = technique.sample(u);
    const auto high = technique.sample(static_cast<float>(u + step));
    if (!low || !middle || !high) continue;
    // Simpson's rule for the mean density between the two, so that curvature does not
    // count.
    const float center = 0.5f * (low->t + high->t);
    const double mean =
        (technique.pdf_t(low->t) + 4 * technique.pdf_t(center) + technique.pdf_t(high->t)) /
        6;
    EXPECT_NEAR(mean * (high->t - low->t) / (2 * step), 1, tolerance) << "u = " << u;
  }
}

/// The taps of a technique are its samples at the middle of each part.
template <typename Technique>
void expect_taps_are_samples(const Geometry& geometry, const Technique& technique) {
  const auto taps = technique.template taps<64>();
  for (size_t i = 0; i < 64; ++i) {
    const double t = technique.sample((static_cast<float>(i) + 0.5f) / 64)->t;
    const double tolerance = 1e-4 * geometry.r(t) + 4 * ulp(t) + 2 * ulp(geometry.foot);
    EXPECT_NEAR(taps.t[i], t, tolerance) << geometry << " " << i;
    EXPECT_NEAR(taps.distance[i], geometry.r(t), tolerance) << geometry << " " << i;
    EXPECT_NEAR(taps.cos_alpha[i], std::cos(geometry.alpha(t)),
                1e-4 + tolerance / geometry.r(t))
        << geometry << " " << i;
  }
}

}  // namespace tyndall
