// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/light_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "guiding/mixtures.h"
#include "support/chi_square.h"
#include "support/statistical_tests.h"
#include "tyndall/math/constants.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

const Vec3 axis = normalize(Vec3{0.3f, -0.8f, 0.4f});
const Frame frame = Frame::from_z(axis);

LightSquare square(SquareMeasure measure) { return LightSquare(frame, measure); }

class LightSquareTest : public testing::TestWithParam<SquareMeasure> {};

INSTANTIATE_TEST_SUITE_P(Measures, LightSquareTest,
                         testing::Values(SquareMeasure::joint_sampling,
                                         SquareMeasure::solid_angle));

/// Rings that crowd to the pole of Georgiev's density.
SphereCells cells_around_axis() {
  return {.rings = 16, .sectors = 16, .pole = axis, .concentration = 8};
}

/// Georgiev's density from its formula, in double precision.
double joint_density(Vec3 w) {
  const double c = static_cast<double>(dot(w, axis));
  const double theta = std::atan2(static_cast<double>(length(cross(w, axis))), c);
  return (M_PI - theta) / (std::pow(M_PI, 3) * std::sin(theta));
}

double expected_density(SquareMeasure measure, Vec3 w) {
  return measure == SquareMeasure::joint_sampling ? joint_density(w) : 1 / (4 * M_PI);
}

TEST_P(LightSquareTest, UniformPointsHaveTheDensityOfTheMeasure) {
  const LightSquare s = square(GetParam());
  const ChiSquareResult r =
      chi_square_sphere([&](Vec2 u) { return std::optional(s.direction(u).w); },
                        [&](Vec3 w) { return expected_density(GetParam(), w); }, 200'000, 3,
                        cells_around_axis());
  EXPECT_GT(r.p_value, sidak(0.01, 2)) << r;
  EXPECT_NEAR(r.mass, 1, 1e-4);
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
}

TEST_P(LightSquareTest, DensitiesAreThoseOfTheFormula) {
  const LightSquare s = square(GetParam());
  RandomStream random(1);
  for (int i = 0; i < 100'000; ++i) {
    const SquareDirection d = s.direction(random.next_2d());
    const double expected = expected_density(GetParam(), d.w);
    const double theta = std::acos(std::min(1.0, static_cast<double>(dot(d.w, axis))));
    const double error = 1e-5 + 3e-7 / std::max(theta, 1e-4);  // of float directions
    ASSERT_NEAR(length(d.w), 1, 1e-6);
    ASSERT_NEAR(d.density, expected, error * expected);
    ASSERT_NEAR(s.point(d.w).density, expected, error * expected);
    ASSERT_EQ(s.point(d.w).density, s.density(d.w));
  }
}

TEST_P(LightSquareTest, PointInvertsDirection) {
  const LightSquare s = square(GetParam());
  RandomStream random(2);
  for (int i = 0; i < 100'000; ++i) {
    const Vec2 p = random.next_2d();
    const Vec2 back = s.point(s.direction(p).w).p;
    // On the edge all points are one direction; an error of a direction is worth more
    // there.
    const float edge = std::min({p.x, 1 - p.x, p.y, 1 - p.y});
    const float middle = std::max(std::abs(p.x - 0.5f), std::abs(p.y - 0.5f));
    const float error =
        1e-6f + 3e-7f / std::max(std::sqrt(edge), 1e-3f) + 1e-7f / std::max(middle, 1e-3f);
    ASSERT_NEAR(back.x, p.x, error) << p.y;
    ASSERT_NEAR(back.y, p.y, error) << p.x;
  }
}

TEST_P(LightSquareTest, DirectionInvertsPoint) {
  const LightSquare s = square(GetParam());
  RandomStream random(2);
  for (int i = 0; i < 100'000; ++i) {
    const float cos_theta = 2 * random.next_1d() - 1;
    const Vec3 w = spherical_direction(cos_theta, 2 * pi * random.next_1d());
    // Near the opposite direction the square's own coordinates are the coarser ones.
    const float error = 3e-6f + 1e-6f / std::max(length(w + axis), 1e-3f);
    ASSERT_LT(distance(s.direction(s.point(w).p).w, w), error);
  }
}

TEST_P(LightSquareTest, DensityIsTheJacobian) {
  const LightSquare s = square(GetParam());
  for (const Vec2 p :
       {Vec2{0.3f, 0.45f}, Vec2{0.6f, 0.9f}, Vec2{0.1f, 0.5f}, Vec2{0.52f, 0.51f}}) {
    const float h = 1.0f / 1024;
    const Vec3 dx = s.direction({p.x + h, p.y}).w - s.direction({p.x - h, p.y}).w;
    const Vec3 dy = s.direction({p.x, p.y + h}).w - s.direction({p.x, p.y - h}).w;
    const float solid_angle =
        length(cross(dx, dy)) / (4 * h * h);  // per area of the square
    EXPECT_NEAR(s.direction(p).density * solid_angle, 1, 2e-3);
  }
}

// The mean cosine of Georgiev's density: the integral of 2 (pi - t) / pi^2 cos t is 4 /
// pi^2.
TEST_P(LightSquareTest, MeanCosineIsThatOfTheMeasure) {
  const LightSquare s = square(GetParam());
  RunningMoments cosine;
  RandomStream random(4);
  for (int i = 0; i < 200'000; ++i) cosine.add(dot(s.direction(random.next_2d()).w, axis));
  const double expected =
      GetParam() == SquareMeasure::joint_sampling ? 4 / (M_PI * M_PI) : 0;
  EXPECT_GT(z_p_value(cosine, expected), sidak(0.01, 2));
}

// The square's orientation: +x of the square is +x of the frame, not its mirror image.
TEST_P(LightSquareTest, TheAxesOfTheSquareAreThoseOfTheFrame) {
  const LightSquare s = square(GetParam());
  EXPECT_GT(dot(s.direction({0.75f, 0.5f}).w, frame.x), 0.4f);
  EXPECT_NEAR(dot(s.direction({0.75f, 0.5f}).w, frame.y), 0, 1e-6);
  EXPECT_GT(dot(s.direction({0.5f, 0.75f}).w, frame.y), 0.4f);
  EXPECT_LT(distance(s.direction({0.5f, 0.5f}).w, axis), 1e-6f);
  EXPECT_LT(distance(s.direction({0, 0.3f}).w, -axis), 1e-6f);
}

TEST_P(LightSquareTest, PolesAreFinite) {
  const LightSquare s = square(GetParam());
  for (const Vec2 p :
       {Vec2{0.5f, 0.5f}, Vec2{0, 0}, Vec2{1, 1}, Vec2{0, 0.5f}, Vec2{1, 0.2f}}) {
    const SquareDirection d = s.direction(p);
    EXPECT_NEAR(length(d.w), 1, 1e-6);
    EXPECT_TRUE(std::isfinite(d.density) && d.density > 0);
  }
  for (const Vec3 w : {axis, -axis}) {
    const SquarePoint q = s.point(w);
    EXPECT_TRUE(q.p.x >= 0 && q.p.x <= 1 && q.p.y >= 0 && q.p.y <= 1);
    EXPECT_TRUE(std::isfinite(q.density) && q.density > 0);
  }
  EXPECT_NEAR(square(SquareMeasure::joint_sampling).density(-axis), 1 / std::pow(M_PI, 3),
              1e-7);
}

// A mixture on the square, carried to the sphere, is sampled by the density that it claims.
TEST_P(LightSquareTest, MixturesOnTheSphereFollowTheirDensity) {
  const LightSquare s = square(GetParam());
  for (const size_t i : {2u, 3u}) {
    const NamedMixture example = example_mixtures()[i];
    const GaussianMixture mixture(example.components);
    const ChiSquareResult r = chi_square_sphere(
        [&](Vec2 u) -> std::optional<Vec3> {
          const auto m = mixture.sample(u);
          if (!m) return std::nullopt;
          return s.direction(m->p).w;
        },
        [&](Vec3 w) {
          const SquarePoint q = s.point(w);
          return static_cast<double>(mixture.pdf(q.p)) * static_cast<double>(q.density);
        },
        100'000, 5, cells_around_axis());
    EXPECT_GT(r.p_value, sidak(0.01, 4)) << example.name << r;
    EXPECT_NEAR(r.mass, static_cast<double>(mixture.inside_mass()), 1e-3) << example.name;
  }
}

TEST(TurnedFrameTest, IsOrthonormalAndKeepsTheReference) {
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const float cos_theta = 2 * random.next_1d() - 1;
    const Vec3 z = spherical_direction(cos_theta, 2 * pi * random.next_1d());
    const Frame f = turned_frame(frame, z);
    EXPECT_LT(distance(f.z, z), 1e-6f);
    EXPECT_NEAR(length(f.x), 1, 1e-5);
    EXPECT_NEAR(length(f.y), 1, 1e-5);
    EXPECT_NEAR(dot(f.x, f.z), 0, 1e-4);
    EXPECT_NEAR(dot(cross(f.x, f.y), f.z), 1, 1e-4);
  }
  const Frame same = turned_frame(frame, axis);
  EXPECT_LT(distance(same.x, frame.x) + distance(same.y, frame.y), 1e-5f);
  EXPECT_NEAR(length(turned_frame(frame, -axis).x), 1, 1e-5);
}

// Frame::from_z() turns half around where z.z changes its sign; this must not.
TEST(TurnedFrameTest, IsContinuousAcrossTheHorizon) {
  const Frame reference = Frame::from_z(Vec3{1, 0, 0});
  const Frame above = turned_frame(reference, normalize(Vec3{0.6f, 0.8f, 1e-4f}));
  const Frame below = turned_frame(reference, normalize(Vec3{0.6f, 0.8f, -1e-4f}));
  EXPECT_LT(distance(above.x, below.x) + distance(above.y, below.y), 1e-3f);
}

}  // namespace
}  // namespace tyndall
