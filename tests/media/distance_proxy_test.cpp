// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/distance_proxy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "media/random_media.h"
#include "support/statistical_tests.h"
#include "tyndall/media/grid_medium.h"
#include "tyndall/media/homogeneous_medium.h"

namespace tyndall {
namespace {

const Bounds3 box{{-1, 0, 2}, {1, 3, 2.5f}};

class ProxyCases : public testing::TestWithParam<std::tuple<Rgb, GridContent, RayStart>> {
 protected:
  ProxyCases() : rng_(hash(1, std::get<1>(GetParam()), std::get<2>(GetParam()))) {}

  GridMedium make_medium() {
    return {random_grid(rng_, {45, 30, 12}, std::get<1>(GetParam())),
            box,
            Transform::rotate(30, {1, 2, 3}),
            {Rgb(0), std::get<0>(GetParam()), {}},
            IsotropicPhase{}};
  }
  Ray make_ray() {
    return random_ray(rng_, std::get<2>(GetParam()), box, Transform::rotate(30, {1, 2, 3}));
  }

  RandomStream rng_;
};

constexpr int case_count = 4 * 3 * 4;
INSTANTIATE_TEST_SUITE_P(
    All, ProxyCases,
    testing::Combine(testing::Values(Rgb(3), Rgb(1e-4f), Rgb(4, 0.5f, 0), Rgb(0, 30, 1)),
                     testing::Values(GridContent::uniform_noise, GridContent::mostly_empty,
                                     GridContent::constant),
                     testing::ValuesIn(all_ray_starts)));

// By the midpoint rule: an adaptive quadrature would chase every jump of the density.
TEST_P(ProxyCases, SamplesFollowTheirPdf) {
  const GridMedium medium = make_medium();
  const Ray ray = make_ray();
  const DistanceProxy proxy(medium, ray, 6);
  if (proxy.opacity() == 0) return;  // the ray meets nothing
  const size_t n = 50'000;
  const double h = 6.0 / n;
  std::vector<double> cdf{0};
  for (size_t i = 0; i < n; ++i)
    cdf.push_back(cdf.back() +
                  h * double{proxy.pdf_t(static_cast<float>((double(i) + 0.5) * h))});
  EXPECT_NEAR(cdf.back(), 1, 1e-3);
  std::vector<double> uniforms;
  RunningMoments moment;
  for (int i = 0; i < 5000; ++i) {
    const double x = double{proxy.sample(rng_.next_1d())->t} / h;
    const size_t k = std::min(static_cast<size_t>(x), n - 1);
    uniforms.push_back(std::min(std::lerp(cdf[k], cdf[k + 1], x - double(k)), 1.0));
    moment.add(uniforms.back());
  }
  EXPECT_GT(uniformity_p_value(uniforms), sidak(0.01, 2 * case_count));
  EXPECT_GT(z_p_value(moment, 0.5), sidak(0.01, 2 * case_count)) << moment.mean();
}

TEST_P(ProxyCases, InvertUndoesSample) {
  const GridMedium medium = make_medium();
  for (int i = 0; i < 20; ++i) {
    const Ray ray = make_ray();
    const DistanceProxy proxy(medium, ray, uniform(rng_, 0.1f, 8));
    float t_before = 0;
    for (int k = 0; k <= 64; ++k) {
      const float u = std::min(static_cast<float>(k) / 64, one_minus_epsilon);
      const auto s = proxy.sample(u);
      if (!s) continue;
      // Far away t itself is rounded, by up to half its spacing.
      const float rounding = 0.5f * std::numeric_limits<float>::epsilon() * s->t;
      EXPECT_NEAR(proxy.invert(s->t), u, 2e-5f + s->pdf_t * rounding);
      EXPECT_GE(s->t, t_before);
      EXPECT_EQ(s->pdf_t, proxy.pdf_t(s->t));
      EXPECT_GT(s->pdf_t, 0);
      t_before = s->t;
    }
  }
}

// d invert / dt is the density, and -d log T_hat / dt is sigma_hat.
TEST_P(ProxyCases, DerivativesAgree) {
  const GridMedium medium = make_medium();
  const DistanceProxy proxy(medium, make_ray(), 6);
  for (int i = 0; i < 100; ++i) {
    const float t = uniform(rng_, 0.01f, 5.9f), h = 1e-3f;
    const Rgb sigma = proxy.sigma_t(t);
    if (!(proxy.sigma_t(t - h) == sigma && proxy.sigma_t(t + h) == sigma)) continue;
    const Rgb slope = (proxy.optical_depth(t + h) - proxy.optical_depth(t - h)) / (2 * h);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(slope[c], sigma[c],
                  2e-3f * (sigma[c] + max_component(proxy.optical_depth(9))));
    const float density = (proxy.invert(t + h) - proxy.invert(t - h)) / (2 * h);
    EXPECT_NEAR(density, proxy.pdf_t(t), 1e-3f * (1 + proxy.pdf_t(t)));
  }
}

// What multiple importance sampling demands: positive wherever a collision can be.
TEST_P(ProxyCases, IsPositiveWhereverTheMediumIs) {
  const GridMedium medium = make_medium();
  for (int i = 0; i < 20; ++i) {
    const Ray ray = make_ray();
    const DistanceProxy proxy(medium, ray, 6);
    auto segments = medium.segments(ray, 6);
    MediumSegment s;
    while (segments.next(s)) {
      const float t = 0.5f * (s.t_min + s.t_max);
      if (segments.sigma_t(t) == Rgb(0)) continue;
      // Only what lies behind e^-80 may vanish.
      if (min_component(proxy.optical_depth(t)) > 80) continue;
      EXPECT_GT(proxy.pdf_t(t), 0) << t;
    }
  }
}

TEST(DistanceProxyTest, IsExactInHomogeneousMedia) {
  const HomogeneousMedium medium({Rgb(0.5f), Rgb(1.5f), {}}, IsotropicPhase{});
  const DistanceProxy proxy(medium, {{0, 0, 0}, {1, 0, 0}}, 2);
  EXPECT_FLOAT_EQ(proxy.pdf_t(0.75f), 2 * std::exp(-1.5f) / (1 - std::exp(-4.0f)));
  EXPECT_EQ(proxy.pdf_t(2.001f), 0);
  EXPECT_FLOAT_EQ(proxy.transmittance(0.75f).g, std::exp(-1.5f));
  EXPECT_FLOAT_EQ(proxy.opacity(), 1 - std::exp(-4.0f));
  const DistanceProxy endless(medium, {{0, 0, 0}, {1, 0, 0}}, infinity);
  EXPECT_FLOAT_EQ(endless.sample(0.5f)->t, 0.5f * std::log(2.0f));
  EXPECT_EQ(endless.opacity(), 1);
}

TEST(DistanceProxyTest, AveragesTheChannelsThatCanCollide) {
  const HomogeneousMedium medium({{1, 0, 4}, Rgb(0), {}}, IsotropicPhase{});
  const DistanceProxy proxy(medium, {{0, 0, 0}, {1, 0, 0}}, 2);
  const float red = std::exp(-0.3f) / (1 - std::exp(-2.0f));
  const float blue = 4 * std::exp(-1.2f) / (1 - std::exp(-8.0f));
  EXPECT_FLOAT_EQ(proxy.pdf_t(0.3f), 0.5f * (red + blue));
  const DistanceProxy endless(medium, {{0, 0, 0}, {1, 0, 0}}, infinity);
  EXPECT_NEAR(endless.invert(endless.sample(0.9f)->t), 0.9f, 1e-5);
}

TEST(DistanceProxyTest, IsEmptyWhereTheRayMeetsNothing) {
  const HomogeneousMedium vacuum({}, IsotropicPhase{});
  const DistanceProxy proxy(vacuum, {{0, 0, 0}, {1, 0, 0}}, infinity);
  EXPECT_FALSE(proxy.sample(0.5f));
  EXPECT_EQ(proxy.pdf_t(1), 0);
  EXPECT_EQ(proxy.transmittance(5), Rgb(1));
  EXPECT_EQ(proxy.opacity(), 0);
}

// A medium with more segments than a proxy holds: alternating, touching, a thousand of
// them.
class StripedMedium {
 public:
  class Segments {
   public:
    bool next(MediumSegment& s) {
      if (i_ == 1000) return false;
      const float t = 0.01f * static_cast<float>(i_);
      const Rgb mean(i_ % 2 == 0 ? 0.1f : 0.3f);
      s = {t, 0.01f * static_cast<float>(++i_), mean, mean};
      return true;
    }

   private:
    int i_ = 0;
  };
  Segments segments(const Ray& /*ray*/, float /*t_max*/) const { return {}; }
  bool is_grey() const { return true; }
};

TEST(DistanceProxyTest, MergesWhatItCannotHold) {
  const DistanceProxy proxy(StripedMedium{}, {{0, 0, 0}, {1, 0, 0}}, 10);
  EXPECT_NEAR(proxy.optical_depth(10).r, 2, 1e-4);
  EXPECT_NEAR(proxy.optical_depth(6).r, 1.2f, 5e-3);
  EXPECT_NEAR(proxy.invert(proxy.sample(0.8f)->t), 0.8f, 1e-5);
}

}  // namespace
}  // namespace tyndall
