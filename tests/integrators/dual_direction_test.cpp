// SPDX-License-Identifier: Apache-2.0
// What is really sampled at the first vertex of a dual connection: the mixture times the
// phase function, joint sampling and the phase function, in shares.
#include "tyndall/integrators/dual_direction.h"

#include <gtest/gtest.h>

#include "support/chi_square.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr Vec3 b{0.2f, -0.1f, 0.3f}, pivot{1, 2, 0.5f};

DirectionGuide guide() {
  DirectionGuide g;
  g.reference = Frame::from_z(normalize(pivot - b));
  const std::vector<GaussianComponent> components{
      {0.6f, {0.62f, 0.41f}, {3e-3f, 1e-3f, 2e-3f}},
      {0.3f, {0.2f, 0.7f}, {8e-3f, 0, 4e-3f}},
      {0.1f, {0.5f, 0.95f}, {2e-2f, 0, 2e-2f}}};
  g.set_mixture(GaussianMixture(components));
  g.shares = {0.5f, 0.3f, 0.2f};
  return g;
}

class DualDirectionTest : public testing::TestWithParam<float> {
 protected:
  PhaseFunction phase{GetParam() == 0 ? PhaseFunction(IsotropicPhase{})
                                      : PhaseFunction(HenyeyGreenstein(GetParam()))};
  ScatteringTables tables{GetParam()};
  DirectionGuide learned = guide();
  Vec3 w_ab = normalize(Vec3{0.3f, 1, 0.4f});

  DualDirection technique(const DirectionGuide* g, bool with_product = true) const {
    return {{tables, phase}, b, w_ab, pivot, g, with_product};
  }
};

INSTANTIATE_TEST_SUITE_P(G, DualDirectionTest, testing::Values(0.0f, 0.6f, -0.4f),
                         [](const auto& tested) {
                           return "g" + std::to_string(static_cast<int>(
                                            std::lround(100 + 100 * tested.param)));
                         });

// That samples follow the density; returns what that integrates to.
double mass_after_chi_square(const DualDirection& direction) {
  const ChiSquareResult r = chi_square_sphere(
      [&](Vec2 u) -> std::optional<Vec3> {
        const auto s = direction.sample(u);
        if (!s) return std::nullopt;
        return s->w;
      },
      [&](Vec3 w) { return double{direction.pdf(w)}; }, 200'000, 1,
      {.pole = normalize(pivot - b), .concentration = 8});
  EXPECT_GT(r.p_value, sidak(0.01, 3)) << r;
  EXPECT_EQ(r.samples_of_zero_pdf, 0);
  return r.mass;
}

TEST_P(DualDirectionTest, SamplesFollowTheDensity) {
  const double mass = mass_after_chi_square(technique(&learned));
  // The mixture's own tails leave the square.
  const LightSquare square = learned.square(normalize(pivot - b));
  const float inside = learned.product(square, w_ab, phase.mean_cosine()).inside_mass();
  EXPECT_NEAR(mass, 0.5 * double{inside} + 0.5, 1e-3);
}

// The same at a surface, with the lobe of a diffuse one.
TEST_P(DualDirectionTest, SamplesFollowTheDensityAtSurfaces) {
  const Vec3 n = w_ab;
  const DualDirection direction(tables, b, n, pivot, &learned);
  mass_after_chi_square(direction);
  const Vec3 below = -n, above = n;
  EXPECT_EQ(direction.densities(below)[static_cast<size_t>(DirectionTechnique::phase)], 0);
  EXPECT_NEAR(direction.densities(above)[static_cast<size_t>(DirectionTechnique::phase)],
              inv_pi, 1e-6f);
}

// Where nothing is known, joint sampling without the scattering at the vertex.
TEST_P(DualDirectionTest, UntaughtSurfacesSampleJointly) {
  const DualDirection direction(tables, b, w_ab, pivot, nullptr);
  const DoubleScatteringDirection joint(tables, b, pivot);
  const Vec3 w = normalize(Vec3{0.3f, -0.2f, 0.9f});
  EXPECT_EQ(direction.pdf(w), joint.pdf(w));
  EXPECT_EQ(direction.sample({0.3f, 0.6f})->w, joint.sample({0.3f, 0.6f})->w);
}

// The mean cosine to the light, from independent draws of the three techniques.
TEST_P(DualDirectionTest, MeanCosineIsThatOfItsParts) {
  const Vec3 axis = normalize(pivot - b);
  const DualDirection direction = technique(&learned);
  const LightSquare square = learned.square(axis);
  const GaussianMixture product = learned.product(square, w_ab, phase.mean_cosine());
  const DoubleScatteringDirection joint(tables, b, w_ab, pivot);
  RandomStream random(11);
  RunningMoments whole, parts;
  for (int i = 0; i < 200'000; ++i) {
    const auto s = direction.sample(random.next_2d());
    whole.add(s ? dot(s->w, axis) : 0);
    const Vec2 u = random.next_2d();
    float cosine = 0;
    if (const float choice = random.next_1d(); choice < 0.5f) {
      const auto m = product.sample(u);
      cosine = m ? dot(square.direction(m->p).w, axis) : 0;
    } else if (choice < 0.8f) {
      const auto m = joint.sample(u);
      cosine = m ? dot(m->w, axis) : 0;
    } else {
      cosine = dot(phase.sample(-w_ab, u)->wi, axis);
    }
    parts.add(cosine);
  }
  EXPECT_GT(welch_p_value(whole, parts), sidak(0.01, 3));
}

// The product moves samples to where the phase function scatters.
TEST_P(DualDirectionTest, ProductRaisesTheMeanOfThePhaseFunction) {
  DirectionGuide mixture_only = learned;
  mixture_only.shares = {1, 0, 0};
  const auto mean = [&](bool with_product) {
    const DualDirection direction = technique(&mixture_only, with_product);
    RandomStream random(12);
    RunningMoments m;
    for (int i = 0; i < 20'000; ++i)
      if (const auto s = direction.sample(random.next_2d())) m.add(phase.eval(-w_ab, s->w));
    return m.mean();
  };
  if (GetParam() == 0)
    EXPECT_EQ(mean(true), mean(false));
  else
    EXPECT_GT(mean(true), 1.05 * mean(false));
}

TEST_P(DualDirectionTest, WithoutKnowledgeItIsJointSampling) {
  const DirectionGuide untrained;
  const DoubleScatteringDirection joint(tables, b, w_ab, pivot);
  RandomStream random(13);
  for (const DirectionGuide* g : {static_cast<const DirectionGuide*>(nullptr), &untrained})
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u = random.next_2d();
      const auto s = technique(g).sample(u), expected = joint.sample(u);
      ASSERT_EQ(s.has_value(), expected.has_value());
      if (!s) continue;
      EXPECT_EQ(s->w, expected->w);
      EXPECT_EQ(s->pdf, expected->pdf);
    }
}

}  // namespace
}  // namespace tyndall
