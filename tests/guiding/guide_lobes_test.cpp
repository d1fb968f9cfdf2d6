// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/guide_lobes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "guiding/mixtures.h"
#include "tyndall/guiding/direction_guide.h"
#include "tyndall/media/phase_function.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

DirectionGuide guide_of(const std::vector<GaussianComponent>& components) {
  DirectionGuide guide;
  guide.reference = Frame::from_z(normalize(Vec3{1, 2, -1}));
  guide.set_mixture(GaussianMixture(components));
  return guide;
}

const Vec3 light = normalize(Vec3{0.5f, 1, 0.2f});

// Mean of a function of directions drawn from one component.
template <typename F>
double mean_over(const GaussianComponent& component, const F& f) {
  DirectionGuide guide = guide_of({component});
  const LightSquare square = guide.square(light);
  RandomStream random(3);
  double sum = 0, n = 0;
  for (int i = 0; i < 100'000; ++i)
    if (const auto s = guide.sample(square, random.next_2d())) sum += f(s->w), n += 1;
  return sum / n;
}

TEST(GuideLobesTest, AxesAndCosinesAreThoseOfTheSamples) {
  for (const NamedMixture& example : example_mixtures())
    for (const GaussianComponent& c : example.components) {
      if (c.covariance.xx > 0.02f || c.covariance.yy > 0.02f) continue;  // reaches the edge
      const DirectionGuide guide = guide_of({c});
      const GuideLobes& lobes = guide.lobes;
      const Frame frame = guide.square(light).frame();
      const Vec3 axis = frame.to_world({lobes.x[0], lobes.y[0], lobes.z[0]});
      const double cosine =
          mean_over(c, [&](Vec3 w) { return static_cast<double>(dot(w, axis)); });
      EXPECT_NEAR(lobes.cosine[0], cosine, 0.03) << example.name;
    }
}

TEST(GuideLobesTest, FactorsAreMeansOfThePhaseFunction) {
  const Vec3 w_ab = normalize(Vec3{0.2f, 0.4f, 1});
  const GaussianComponent narrow{1, {0.45f, 0.55f}, {4e-4f, 1e-4f, 3e-4f}};
  const GaussianComponent wide{1, {0.7f, 0.4f}, {6e-3f, 0, 4e-3f}};
  for (const float g : {-0.5f, 0.3f, 0.75f}) {
    const HenyeyGreenstein phase(g);
    const auto mean = [&](const GaussianComponent& c) {
      return mean_over(c, [&](Vec3 w) { return double{phase.eval(-w_ab, w)}; });
    };
    const DirectionGuide guide = guide_of({narrow, wide});
    const Vec3 axis = guide.square(light).frame().to_local(w_ab);
    const GuideLobes::Lanes f = guide.lobes.phase_factors(axis, g);
    EXPECT_NEAR(f[0] / f[1] / (mean(narrow) / mean(wide)), 1, 0.15) << g;
  }
}

TEST(GuideLobesTest, ReweightedMixtureHasTheProductsAsWeights) {
  const std::vector<GaussianComponent> all = example_mixtures().back().components;
  const GaussianMixture mixture(all);
  GaussianMixture::Lanes factors;
  for (size_t k = 0; k < factors.size(); ++k) factors[k] = static_cast<float>(k + 1);
  std::vector<GaussianComponent> expected = all;
  for (size_t k = 0; k < expected.size(); ++k) expected[k].weight *= factors[k];
  const GaussianMixture a = mixture.reweighted(factors), b(expected);
  RandomStream random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = random.next_2d();
    EXPECT_NEAR(a.pdf(p) / b.pdf(p), 1, 1e-5);
  }
  for (int k = 0; k < a.size(); ++k)
    EXPECT_NEAR(a.component(k).weight, b.component(k).weight, 1e-6f);
}

TEST(GuideLobesTest, UselessFactorsChangeNothing) {
  const GaussianMixture mixture(example_mixtures().back().components);
  EXPECT_EQ(mixture.reweighted(GaussianMixture::Lanes{}), mixture);
  GaussianMixture::Lanes infinite;
  infinite.fill(infinity);
  EXPECT_EQ(mixture.reweighted(infinite), mixture);
}

}  // namespace
}  // namespace tyndall
