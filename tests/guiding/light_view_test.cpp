// SPDX-License-Identifier: Apache-2.0
#include "tyndall/guiding/light_view.h"

#include <gtest/gtest.h>

#include <limits>

#include "tyndall/math/constants.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

struct NamedView {
  const char* name;
  LightView view;
};

std::vector<NamedView> views() {
  const Vec3 p{1, -2, 3}, axis = normalize(Vec3{1, 2, -2});
  return {{"sphere", LightView::around(p)},
          {"narrow_cone", LightView::cone(p, axis, 0.99f)},
          {"wide_cone", LightView::cone(p, axis, 0.3f)},
          {"half_space", LightView::cone(p, axis, 0)},
          {"parallel", LightView::parallel(axis, {{-3, -2, -1}, {5, 6, 7}})}};
}

class LightViewTest : public testing::TestWithParam<NamedView> {
 protected:
  LightView view = GetParam().view;
};

INSTANTIATE_TEST_SUITE_P(Views, LightViewTest, testing::ValuesIn(views()),
                         [](const auto& example) { return example.param.name; });

TEST_P(LightViewTest, ProjectInvertsRay) {
  RandomStream random(1);
  for (int i = 0; i < 100'000; ++i) {
    const Vec2 uv = random.next_2d();
    const float t = 0.1f + 9 * random.next_1d();
    const Ray ray = view.ray(uv);
    ASSERT_NEAR(length(ray.d), 1, 1e-6);
    const ViewPoint q = view.project(ray.at(t));
    ASSERT_NEAR(q.distance, t, 1e-5f * (1 + t));
    ASSERT_NEAR(q.uv.x, uv.x, 2e-5f);
    ASSERT_NEAR(q.uv.y, uv.y, 2e-5f);
  }
}

TEST_P(LightViewTest, ABatchIsItsPoints) {
  RandomStream random(2);
  const Ray ray{{3, 1, -2}, normalize(Vec3{-0.3f, -0.4f, 0.9f})};
  std::vector<float> t(ViewBatch::capacity - 3);
  for (float& v : t) v = 10 * random.next_1d();
  ViewBatch batch;
  view.project(ray, t, batch);
  for (size_t i = 0; i < t.size(); ++i) {
    const ViewPoint q = view.project(ray.at(t[i]));
    EXPECT_NEAR(batch.u[i], q.uv.x, 1e-5f);
    EXPECT_NEAR(batch.v[i], q.uv.y, 1e-5f);
    EXPECT_NEAR(batch.distance[i], q.distance, 1e-5f);
  }
}

// A point has coordinates in range wherever it is, the light itself and infinity included.
TEST_P(LightViewTest, CoordinatesStayInRange) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3 p : {Vec3{1, -2, 3}, Vec3{1e30f, 0, 0}, Vec3{0, -1e30f, 1e-30f},
                       Vec3{infinity, 1, 1}, Vec3{nan, 0, 0}, Vec3{-1e6f, 1e6f, 1e6f}}) {
    const ViewPoint q = view.project(p);
    const bool out_of_cone = q.uv.x == -1 && q.uv.y == -1;
    EXPECT_TRUE(out_of_cone || (q.uv.x >= 0 && q.uv.x < 1 && q.uv.y >= 0 && q.uv.y < 1));
  }
}

TEST(LightConeTest, KnowsWhatIsOutside) {
  const LightView view = LightView::cone({0, 0, 0}, {0, 0, 1}, 0.9f);
  EXPECT_EQ(view.project({0, 0, -1}).uv.x, -1);
  EXPECT_EQ(view.project({1, 0, 1}).uv.x, -1);
  // The rim of the light itself is inside.
  const float sine = std::sqrt(1 - 0.9f * 0.9f);
  for (int i = 0; i < 16; ++i) {
    const float phi = static_cast<float>(i) * pi / 8;
    const Vec3 rim{sine * std::cos(phi), sine * std::sin(phi), 0.9f};
    EXPECT_GE(view.project(rim).uv.x, 0);
  }
}

// Neighbouring texels are neighbouring directions: the octahedral fold is continuous.
TEST(LightViewSphereTest, DirectionsAreContinuous) {
  const LightView view = LightView::around({0, 0, 0});
  RandomStream random(3);
  for (int i = 0; i < 10'000; ++i) {
    const Vec2 uv = random.next_2d();
    const Vec2 next{std::min(uv.x + 1e-3f, 1.0f), uv.y};
    ASSERT_LT(distance(view.ray(uv).d, view.ray(next).d), 8e-3f);
  }
}

}  // namespace
}  // namespace tyndall
