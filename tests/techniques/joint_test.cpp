// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/chi_square.h"
#include "support/statistical_tests.h"
#include "techniques/references.h"
#include "tyndall/sampling/random.h"
#include "tyndall/techniques/double_scattering_direction.h"
#include "tyndall/techniques/double_scattering_distance.h"
#include "tyndall/techniques/single_scattering_distance.h"

namespace tyndall {
namespace {

const Ray ray{{0, 0, 0}, {0, 0, 1}};
const Vec3 light{1, 0, 2};
constexpr float t_max = 5;

/// The random decisions of a three-connection, and their density.
struct Connection {
  float t_ab;
  Vec3 w;
  float t_bc;
  double pdf;
};

std::optional<Connection> sample_connection(const ScatteringTables& tables,
                                            RandomStream& random) {
  const auto ab =
      DoubleScatteringDistance(tables, ray, light, 0, t_max).sample(random.next_1d());
  if (!ab) return std::nullopt;
  const Vec3 b = ray.at(ab->t);
  const auto w =
      DoubleScatteringDirection(tables, b, ray.d, light).sample(random.next_2d());
  if (!w) return std::nullopt;
  const auto bc = SingleScatteringDistance(tables, {b, w->w}, light, 0, infinity)
                      .sample(random.next_1d());
  if (!bc) return std::nullopt;
  return Connection{ab->t, w->w, bc->t, double{ab->pdf_t} * w->pdf * bc->pdf_t};
}

/// A connection in double precision: what its float positions stand for.
struct Shape {
  double alpha, theta, phi, psi;  ///< angles at b from the light, about it, and at c
  double distance_bd, distance_cd;
  double cos_b;  ///< of the deflection at b

  explicit Shape(const Connection& c) {
    const double w[3] = {c.w.x, c.w.y, c.w.z};
    double bd[3] = {light.x, light.y, light.z - double(c.t_ab)}, cd[3];
    double to_c = 0, to_d = 0;
    for (int i = 0; i < 3; ++i) {
      cd[i] = bd[i] - c.t_bc * w[i];
      to_c += bd[i] * w[i];
      to_d += cd[i] * w[i];
    }
    distance_bd = std::hypot(bd[0], bd[1], bd[2]);
    distance_cd = std::hypot(cd[0], cd[1], cd[2]);
    const double across =
        std::hypot(bd[1] * w[2] - bd[2] * w[1], bd[2] * w[0] - bd[0] * w[2],
                   bd[0] * w[1] - bd[1] * w[0]);
    alpha = std::atan2(bd[0], bd[2]);
    theta = std::atan2(across, to_c);
    psi = std::atan2(across, to_d);
    cos_b = w[2];
    // About the axis to the light, from the half-plane of the ray: x' = z - axis cos, y' =
    // -y.
    const double axis_x = bd[0] / distance_bd, axis_z = bd[2] / distance_bd;
    phi = std::atan2(-w[1], w[2] * axis_x - w[0] * axis_z);
  }

  double integrand(double g) const {
    return henyey_greenstein(g, std::cos(psi)) * henyey_greenstein(g, cos_b) /
           (distance_cd * distance_cd);
  }
};

TEST(ThreeConnection, HasNoVarianceInIsotropicMedia) {
  const ScatteringTables tables(0);
  RandomStream random(1);
  RunningMoments weights;
  for (int i = 0; i < 100'000; ++i) {
    const auto c = sample_connection(tables, random);
    if (c) weights.add(Shape(*c).integrand(0) / c->pdf);
  }
  // [Georgiev13]: twice scattered light of a source of unit power is the integral / (4 pi),
  // known in closed form.
  const double expected = (std::asinh(3.0) - std::asinh(-2.0)) / 64;
  EXPECT_GE(weights.count(), 99'999);  // at most the one in the singular direction is empty
  EXPECT_NEAR(weights.mean() / (4 * M_PI) / expected, 1, 1e-6);
  EXPECT_LT(std::sqrt(weights.variance()) / weights.mean(), 1e-5);
}

class JointTest : public testing::TestWithParam<float> {};
constexpr float asymmetries[] = {-0.9f, -0.5f, 0.5f, 0.75f, 0.9f, 0.95f, 0.99f};
INSTANTIATE_TEST_SUITE_P(Asymmetry, JointTest, testing::ValuesIn(asymmetries));

TEST_P(JointTest, HasTheVarianceOfItsTablesOnly) {
  const float g = GetParam();
  const ScatteringTables tables(g);
  RandomStream random(1);
  RunningMoments weights;
  for (int i = 0; i < 20'000; ++i) {
    const auto c = sample_connection(tables, random);
    ASSERT_TRUE(c.has_value());
    weights.add(Shape(*c).integrand(g) / c->pdf);
  }
  const double relative_variance = weights.variance() / sqr(weights.mean());
  // Piecewise constant tables of 20 k to 70 k floats leave 2e-4, 1e-3, 6e-3, 2.7e-2.
  const double limit = std::abs(g) <= 0.5   ? 1e-6
                       : std::abs(g) <= 0.9 ? 1e-5
                       : g <= 0.95          ? 1e-4
                                            : 0.02;
  EXPECT_LT(relative_variance, limit);
  double expected = 0;
  constexpr int steps = 200;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) * t_max / steps;
    expected += scattered_twice(g, std::atan2(1.0, 2 - t), M_PI) / std::hypot(1.0, t - 2) *
                t_max / steps;
  }
  EXPECT_NEAR(weights.mean() / expected, 1, 5e-5 + 4 * std::sqrt(limit / 20'000));
}

/// Uniform in the cube if the connections follow the integrand: each decision through the
/// distribution function of the integrand given those before (Rosenblatt's transform).
std::vector<double> rosenblatt(const Connection& c, double g,
                               const std::vector<double>& cdf_ab) {
  const Shape shape(c);
  const double at = c.t_ab / t_max * static_cast<double>(cdf_ab.size() - 1);
  const auto i = std::min(static_cast<size_t>(at), cdf_ab.size() - 2);
  const double ab = std::lerp(cdf_ab[i], cdf_ab[i + 1], at - static_cast<double>(i));
  const double theta =
      scattered_twice(g, shape.alpha, shape.theta) / scattered_twice(g, shape.alpha, M_PI);
  const double half = azimuth_arc(g, shape.alpha, shape.theta, std::abs(shape.phi)) /
                      azimuth_arc(g, shape.alpha, shape.theta, M_PI) / 2;
  const double bc =
      (arc(g, shape.psi) - arc(g, shape.theta)) / (arc(g, M_PI) - arc(g, shape.theta));
  return {ab, theta, shape.phi < 0 ? 0.5 - half : 0.5 + half, bc};
}

TEST_P(JointTest, RosenblattTransformIsUniform) {
  const float g = GetParam();
  if (std::abs(g) > 0.8f) return;  // the references take too long
  const ScatteringTables tables(g);
  std::vector<double> cdf{0};
  constexpr int cells = 200;
  for (int i = 0; i < cells; ++i) {
    const double t = (i + 0.5) * t_max / cells;
    cdf.push_back(cdf.back() + scattered_twice(g, std::atan2(1.0, 2 - t), M_PI) /
                                   std::hypot(1.0, t - 2));
  }
  for (double& value : cdf) value /= cdf.back();

  RandomStream random(2);
  std::vector<std::vector<double>> axes(4);
  for (int i = 0; i < 600; ++i) {
    const auto c = sample_connection(tables, random);
    ASSERT_TRUE(c.has_value());
    const std::vector<double> u = rosenblatt(*c, g, cdf);
    for (size_t k = 0; k < 4; ++k) axes[k].push_back(u[k]);
  }
  constexpr int tests = 10 * 3;
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_GT(uniformity_p_value(axes[k]), sidak(0.01, tests)) << "decision " << k;
    for (size_t l = 0; l < k; ++l) {
      // Folded along a diagonal, two independent uniform numbers are uniform again.
      std::vector<double> sums;
      for (size_t i = 0; i < axes[k].size(); ++i)
        sums.push_back(std::fmod(axes[k][i] + axes[l][i], 1.0));
      EXPECT_GT(uniformity_p_value(sums), sidak(0.01, tests))
          << "decisions " << l << ", " << k;
    }
  }
}

}  // namespace
}  // namespace tyndall
