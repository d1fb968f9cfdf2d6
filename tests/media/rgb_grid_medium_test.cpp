// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/rgb_grid_medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "media/random_media.h"
#include "support/statistical_tests.h"
#include "tyndall/media/transmittance.h"

namespace tyndall {
namespace {

const Bounds3 box{{-1, 0, 2}, {1, 3, 2.5f}};

RgbGrid random_colors(RandomStream& rng, Vec3i resolution) {
  RgbGrid grid{resolution, {}};
  for (int i = resolution.x * resolution.y * resolution.z; i > 0; --i)
    grid.values.push_back(
        {rng.next_1d(), 2 * rng.next_1d(), rng.next_1d() < 0.1f ? 4.0f : 0});
  return grid;
}

DensityGrid sum_of_channel(const RgbGrid& a, const RgbGrid& b, int c, float scale) {
  DensityGrid sum{a.resolution, {}};
  for (size_t i = 0; i < a.values.size(); ++i)
    sum.values.push_back(scale * (a.values[i][c] + b.values[i][c]));
  return sum;
}

class RgbGridTest : public testing::Test {
 protected:
  RandomStream rng_{1};
  RgbGrid sigma_a_ = random_colors(rng_, {17, 11, 9});
  RgbGrid sigma_s_ = random_colors(rng_, {17, 11, 9});
  RgbGrid Le_ = random_colors(rng_, {17, 11, 9});
  Transform world_from_medium_ = random_transform(rng_, Placement::sheared);
  RgbGridMedium medium_{{.sigma_a = sigma_a_, .sigma_s = sigma_s_, .Le = Le_},
                        box,
                        world_from_medium_,
                        0.5f,
                        3,
                        IsotropicPhase{}};
};

TEST_F(RgbGridTest, InterpolatesEachChannel) {
  EXPECT_TRUE(medium_.is_emissive());
  EXPECT_FALSE(medium_.is_grey());
  for (int i = 0; i < 200; ++i) {
    const Vec3 p =
        box.min + box.diagonal() * Vec3{rng_.next_1d(), rng_.next_1d(), rng_.next_1d()};
    const MediumProperties found = medium_.at(world_from_medium_.point(p));
    for (int c = 0; c < 3; ++c) {
      const auto expected = [&](const RgbGrid& grid, float scale) {
        RgbGrid zero = grid;
        for (Rgb& v : zero.values) v = Rgb(0);
        return reference_density(sum_of_channel(grid, zero, c, scale), box, Transform(), p);
      };
      EXPECT_NEAR(found.sigma_a[c], expected(sigma_a_, 0.5f), 1e-4);
      EXPECT_NEAR(found.sigma_s[c], expected(sigma_s_, 0.5f), 1e-4);
      EXPECT_NEAR(found.Le[c], expected(Le_, 3), 1e-3);
    }
  }
}

TEST_F(RgbGridTest, MajorantsHold) {
  for (int i = 0; i < 200; ++i) {
    const Ray ray = random_ray(rng_, all_ray_starts[i % 4], box, world_from_medium_);
    auto segments = medium_.segments(ray, infinity);
    MediumSegment s;
    while (segments.next(s))
      for (int k = 1; k < 20; ++k) {
        const float t = std::lerp(s.t_min, s.t_max, static_cast<float>(k) / 20);
        const Rgb free = segments.sigma_t_anywhere(t), bound = segments.sigma_t(t);
        for (int c = 0; c < 3; ++c) {
          ASSERT_LE(free[c], s.majorant[c] * 1.0001f + 1e-4f);
          ASSERT_LE(bound[c], s.majorant[c]);
        }
      }
  }
}

TEST_F(RgbGridTest, TransmittanceIsUnbiased) {
  const Medium medium(medium_);
  for (const TransmittanceMethod method :
       {TransmittanceMethod::ratio_tracking, TransmittanceMethod::residual_ratio_tracking,
        TransmittanceMethod::ray_marching}) {
    RunningMoments error[3];
    for (int i = 0; i < 40; ++i) {
      const Ray ray = random_ray(rng_, all_ray_starts[i % 4], box, world_from_medium_);
      double exact[3];
      for (int c = 0; c < 3; ++c)
        exact[c] = std::exp(-reference_optical_depth(
            sum_of_channel(sigma_a_, sigma_s_, c, 0.5f), box, world_from_medium_, ray, 50));
      for (int k = 0; k < 300; ++k) {
        const Rgb T = estimate_transmittance(medium, ray, 50, rng_, method);
        for (int c = 0; c < 3; ++c) error[c].add(double{T[c]} - exact[c]);
      }
    }
    for (const RunningMoments& e : error)
      EXPECT_GT(z_p_value(e, 0), sidak(0.01, 9))
          << e.mean() << " +- " << e.standard_error();
  }
}

// One red sample is so large that walks by its bound all over the cell would not end.
class HugeSampleTest : public testing::TestWithParam<float> {
 protected:
  static constexpr Vec3i n{8, 8, 8};
  const Bounds3 box_{{-1, -1, -1}, {1, 1, 1}};
  // Sample 200 is the first of its row, at (-7/8, -5/8, -1/8).
  RgbGrid sigma_s_{n, std::vector<Rgb>(512, Rgb(1))};
  const RgbGrid sigma_a_{n, std::vector<Rgb>(512, Rgb(0.1f))};

  RgbGridMedium medium() {
    sigma_s_.values[200].r = GetParam();
    return {{.sigma_a = sigma_a_, .sigma_s = sigma_s_, .Le = {}},
            box_,
            Transform(),
            1,
            1,
            IsotropicPhase{}};
  }
};

INSTANTIATE_TEST_SUITE_P(All, HugeSampleTest, testing::Values(1e8f, 1e29f));

// Past it, through cells that it shares, and into it.
TEST_P(HugeSampleTest, TransmittanceIsUnbiased) {
  const Medium medium(this->medium());
  for (const float y : {-0.2f, -0.6f}) {
    const Ray ray{{-2, y, -0.2f}, {1, 0, 0}};
    double exact[3];
    for (int c = 0; c < 3; ++c)
      exact[c] = std::exp(-reference_optical_depth(sum_of_channel(sigma_a_, sigma_s_, c, 1),
                                                   box_, Transform(), ray, 4));
    for (const TransmittanceMethod method :
         {TransmittanceMethod::ratio_tracking,
          TransmittanceMethod::residual_ratio_tracking}) {
      RandomStream rng(hash(8, y < -0.5f, method));
      RunningMoments error[3];
      for (int i = 0; i < 20'000; ++i) {
        const Rgb T = estimate_transmittance(medium, ray, 4, rng, method);
        for (int c = 0; c < 3; ++c) error[c].add(double{T[c]} - exact[c]);
      }
      for (const RunningMoments& e : error)
        EXPECT_NEAR(e.mean(), 0, 5 * e.standard_error() + 1e-6);
    }
  }
}

TEST_P(HugeSampleTest, MajorantsHoldAndAreCloseToOne) {
  const RgbGridMedium medium = this->medium();
  RandomStream rng(9);
  float lowest = infinity;
  for (int i = 0; i < 400; ++i) {
    const Ray ray = random_ray(rng, all_ray_starts[i % 4], box_, Transform());
    auto segments = medium.segments(ray, infinity);
    MediumSegment s;
    while (segments.next(s)) {
      // All of a stretch through the corner of a cell is near its ends.
      if (s.t_max - s.t_min < 1e-3f) continue;
      const Vec3 middle = ray.at(0.5f * (s.t_min + s.t_max));
      if (distance(middle, {-0.875f, -0.625f, -0.125f}) < 0.6f)
        lowest = std::min(lowest, s.majorant.r);
      for (int k = 1; k < 20; ++k) {
        const float t = std::lerp(s.t_min, s.t_max, static_cast<float>(k) / 20);
        ASSERT_LE(segments.sigma_t_anywhere(t).r, s.majorant.r * 1.0001f + 1e-4f);
        ASSERT_LE(segments.sigma_t_anywhere(t).g, s.majorant.g * 1.0001f + 1e-4f);
      }
    }
  }
  EXPECT_LT(lowest, 1.2f);
}

// To an optical depth of 1e6 from one sample to the next, a quarter apart.
TEST_P(HugeSampleTest, IsReducedInProportion) {
  sigma_s_.values[201].r = 1e30f;
  RgbGrid sigma_a = sigma_a_;
  sigma_a.values[201].r = 1e30f;
  const RgbGridMedium medium({.sigma_a = sigma_a, .sigma_s = sigma_s_, .Le = {}}, box_,
                             Transform(), 1, 1, IsotropicPhase{});
  EXPECT_TRUE(medium.is_reduced());
  const MediumProperties at = medium.at({-0.625f, -0.625f, -0.125f});
  EXPECT_NEAR(at.sigma_t().r, 4e6f, 1e-4f * 4e6f);
  EXPECT_NEAR(at.sigma_s.r, 2e6f, 1e-4f * 2e6f);
  EXPECT_FLOAT_EQ(at.sigma_s.g, 1);
}

}  // namespace
}  // namespace tyndall
