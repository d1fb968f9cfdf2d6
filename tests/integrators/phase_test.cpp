// SPDX-License-Identifier: Apache-2.0
// Connections know a phase function by its mean cosine; what they find must not depend on
// that.
#include <gtest/gtest.h>

#include <vector>

#include "scenes.h"
#include "support/statistical_tests.h"

namespace tyndall {
namespace {

class PhaseTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Integrators, PhaseTest,
                         testing::Values("equiangular", "jis", "learned"));

RunningMoments look(const std::string& integrator, const PhaseFunction& phase,
                    uint64_t seed, int count) {
  SceneDescription d;
  d.camera = test::camera({0, 0, 0}, {0, 0, 1});
  d.camera_medium = 0;
  d.media.push_back(Medium(HomogeneousMedium({Rgb(0.1f), Rgb(0.6f), Rgb(0)}, phase)));
  d.surfaces.push_back(test::diffuse_disk(4, 3, 0.6f));
  // Not a point: next event estimation alone would have infinite variance in the fog.
  Surface lamp = test::boundary_sphere(0.3f, {1, 1, 2}, no_medium, no_medium);
  lamp.material = DiffuseBsdf{Rgb(0.0f)};
  lamp.media = {};
  lamp.emission = AreaEmission{Rgb(10), false};
  d.surfaces.push_back(lamp);
  const Scene scene(std::move(d));
  RenderSettings s = test::settings(integrator, 3);
  s.seed = seed;
  return test::estimate(scene, s, count, [](Sampler&) {
    return Ray{{0, 0, 0}, normalize(Vec3{0.2f, 0, 1})};
  });
}

// A forward peak and a backward one; zero between, so that tables by mean cosine are wrong.
PhaseFunction two_peaks() {
  std::vector<float> values(33, 0.0f);
  values.front() = values[1] = 1;
  values.back() = values[31] = 2;
  return TabulatedPhase(values);
}

TEST_P(PhaseTest, AgreesWithTheWalkForAnyPhaseFunction) {
  const std::vector<PhaseFunction> phases{
      RayleighPhase(), TwoLobePhase(HenyeyGreenstein(0.85f), HenyeyGreenstein(-0.5f), 0.7f),
      two_peaks()};
  for (size_t i = 0; i < phases.size(); ++i) {
    const RunningMoments walk = look("volpath", phases[i], 2 * i + 1, 60'000);
    const RunningMoments connected = look(GetParam(), phases[i], 2 * i + 2, 100'000);
    EXPECT_LT(connected.standard_error(), 0.04 * connected.mean()) << i;
    EXPECT_GT(welch_p_value(walk, connected), sidak(0.01, 9))
        << i << ": " << walk.mean() << " +- " << walk.standard_error() << " and "
        << connected.mean() << " +- " << connected.standard_error();
  }
}

}  // namespace
}  // namespace tyndall
