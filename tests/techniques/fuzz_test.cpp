// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tyndall/sampling/random.h"
#include "tyndall/techniques/binned_distance.h"
#include "tyndall/techniques/double_scattering_direction.h"
#include "tyndall/techniques/double_scattering_distance.h"
#include "tyndall/techniques/equiangular.h"
#include "tyndall/techniques/exponential_distance.h"
#include "tyndall/techniques/point_normal.h"
#include "tyndall/techniques/single_scattering_distance.h"

namespace tyndall {
namespace {

/// Numbers that break things: any bits, special values, and ordinary numbers among them, so
/// that everything else about the input is often in order.
class Fuzz {
 public:
  explicit Fuzz(uint64_t seed) : random_(seed) {}

  float number() {
    constexpr float special[] = {0,
                                 -0.0f,
                                 1,
                                 -1,
                                 infinity,
                                 -infinity,
                                 std::numeric_limits<float>::quiet_NaN(),
                                 std::numeric_limits<float>::max(),
                                 std::numeric_limits<float>::lowest(),
                                 std::numeric_limits<float>::min(),
                                 std::numeric_limits<float>::denorm_min(),
                                 1e-20f,
                                 1e20f,
                                 1e-6f,
                                 1e6f};
    switch (random_.next_bits() % 16) {
      case 0:
        return std::bit_cast<float>(random_.next_bits());
      case 1:
        return special[random_.next_bits() % std::size(special)];
      case 2: {
        const float mantissa = random_.next_1d() - 0.5f;
        return std::ldexp(mantissa, int(random_.next_bits() % 80) - 40);
      }
      case 3:
        return 0;
      default:
        return 4 * random_.next_1d() - 2;
    }
  }
  Vec3 vector() { return {number(), number(), number()}; }
  Vec3 direction() { return random_.next_bits() % 8 == 0 ? vector() : normalize(vector()); }
  float uniform() { return random_.next_bits() % 8 == 0 ? number() : random_.next_1d(); }

 private:
  RandomStream random_;
};

constexpr int rounds = 60'000;

template <typename Technique>
int expect_sound(const Technique& technique, Fuzz& fuzz) {
  const auto sample = technique.sample(fuzz.uniform());
  if (sample) {
    EXPECT_TRUE(std::isfinite(sample->t));
    EXPECT_TRUE(sample->pdf_t > 0 && std::isfinite(sample->pdf_t)) << sample->pdf_t;
    const float u = technique.invert(sample->t);
    EXPECT_TRUE(u >= 0 && u <= 1) << u;
  }
  const float pdf = technique.pdf_t(fuzz.number());
  EXPECT_TRUE(pdf >= 0 && std::isfinite(pdf)) << pdf;
  return sample ? 1 : 0;
}

class FuzzTest : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(Asymmetry, FuzzTest,
                         testing::Values(0.0f, 0.7f, -0.95f, 0.9999f, -0.9999f));

TEST_P(FuzzTest, DistancesAreFiniteAndDensitiesNotNegative) {
  const ScatteringTables tables(GetParam());
  Fuzz fuzz(1);
  int samples = 0;
  for (int i = 0; i < rounds && !HasFailure(); ++i) {
    const Ray ray{fuzz.vector(), fuzz.direction()};
    const Vec3 pivot = fuzz.vector(), n = fuzz.direction();
    const float t_min = fuzz.number(), t_max = fuzz.number();
    const EquiangularSampling equiangular(ray, pivot, t_min, t_max);
    samples += expect_sound(equiangular, fuzz);
    samples +=
        expect_sound(SingleScatteringDistance(tables, ray, pivot, t_min, t_max), fuzz);
    samples +=
        expect_sound(DoubleScatteringDistance(tables, ray, pivot, t_min, t_max), fuzz);
    samples += expect_sound(PointNormalSampling(ray, pivot, n, t_min, t_max), fuzz);
    samples += expect_sound(ExponentialDistance(fuzz.number(), t_min, t_max), fuzz);
    auto weights = DistanceWeights<16>::ones();
    const auto taps = equiangular.taps<16>();
    weights.multiply_transmittance(taps, fuzz.number()).multiply_phase(taps, GetParam());
    for (int k = 0; k < 4; ++k) weights.values[static_cast<size_t>(k)] = fuzz.number();
    samples += expect_sound(
        BinnedDistance<EquiangularSampling, 8>(equiangular, weights, 0.05f), fuzz);
  }
  EXPECT_GT(samples, rounds) << "hardly anything was tested";
}

TEST_P(FuzzTest, DirectionsAreFiniteAndDensitiesNotNegative) {
  const ScatteringTables tables(GetParam());
  Fuzz fuzz(2);
  int samples = 0;
  for (int i = 0; i < rounds && !HasFailure(); ++i) {
    const Vec3 b = fuzz.vector(), w_ab = fuzz.direction(), pivot = fuzz.vector();
    const DoubleScatteringDirection with_phase(tables, b, w_ab, pivot),
        without(tables, b, pivot);
    for (const DoubleScatteringDirection* technique : {&with_phase, &without}) {
      const auto sample = technique->sample({fuzz.uniform(), fuzz.uniform()});
      if (sample) {
        ++samples;
        EXPECT_TRUE(is_finite(sample->w));
        EXPECT_TRUE(sample->pdf > 0 && std::isfinite(sample->pdf)) << sample->pdf;
        const Vec2 u = technique->invert(sample->w);
        EXPECT_TRUE(u.x >= 0 && u.x <= 1 && u.y >= 0 && u.y <= 1) << u.x << " " << u.y;
      }
      const float pdf = technique->pdf(fuzz.direction());
      EXPECT_TRUE(pdf >= 0 && std::isfinite(pdf)) << pdf;
    }
  }
  EXPECT_GT(samples, rounds / 2) << "hardly anything was tested";
}

}  // namespace
}  // namespace tyndall
