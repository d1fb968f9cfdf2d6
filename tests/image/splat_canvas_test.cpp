// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/splat_canvas.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/statistical_tests.h"
#include "tyndall/sampling/random.h"

namespace tyndall {
namespace {

constexpr Vec2i full_size{12, 9}, crop_min{2, 3}, crop_max{9, 8};

FilterSettings filter_of(FilterKind kind) {
  return {.kind = kind,
          .radius = kind == FilterKind::box ? Vec2{0.5f, 0.5f} : Vec2{1.7f, 2}};
}

float field(Vec2 p) { return 1 + 0.1f * p.x * p.y + (p.x > 5.3f ? 4.0f : 0.0f); }

class SplatCanvasTest : public testing::TestWithParam<FilterKind> {
 protected:
  Filter filter_{filter_of(GetParam())};
  SplatCanvas canvas_{filter_, crop_min, crop_max};
  RandomStream random_{3};

  // Evenly over more than the picture.
  Splat splat() {
    const Vec2 u = random_.next_2d();
    const Vec2 p{16 * u.x - 2, 13 * u.y - 2};
    return {p, Rgb(field(p) * 16 * 13)};
  }
};

INSTANTIATE_TEST_SUITE_P(Filters, SplatCanvasTest,
                         testing::Values(FilterKind::box, FilterKind::triangle,
                                         FilterKind::gaussian, FilterKind::mitchell));

// Splats of a field are worth what samples drawn from the filter are.
TEST_P(SplatCanvasTest, SplatsEqualFilteredSamples) {
  constexpr int splats = 400'000, samples = 20'000;
  std::vector<std::vector<Splat>> batches(3);
  Film film(full_size, crop_min, crop_max);
  for (int i = 0; i < splats; ++i) {
    batches[static_cast<size_t>(i % 3)].push_back(splat());
    if (i % 1000 != 999) continue;
    canvas_.add(batches);
    canvas_.give(film, 1e-3);
    for (auto& batch : batches) batch.clear();
  }
  const Image image = film.develop();
  const int pixels = image.width() * image.height();
  for (int i = 0; i < pixels; ++i) {
    const Vec2 center{static_cast<float>(crop_min.x + i % image.width()) + 0.5f,
                      static_cast<float>(crop_min.y + i / image.width()) + 0.5f};
    RunningMoments expected;
    for (int k = 0; k < samples; ++k) {
      const FilterSample s = filter_.sample(random_.next_2d());
      expected.add(double{s.weight * field(center + s.offset)});
    }
    const double error =
        std::sqrt(double{image.find("variance.G")->values[static_cast<size_t>(i)]} +
                  sqr(expected.standard_error()));
    const double found = image.find("G")->values[static_cast<size_t>(i)];
    EXPECT_GT(z_p_value(found, error, expected.mean()), sidak(0.01, 4 * pixels)) << i;
    EXPECT_LT(error, 0.1 * expected.mean()) << i;
  }
}

TEST_P(SplatCanvasTest, SeesWhatReachesAPixel) {
  for (int i = 0; i < 20'000; ++i) {
    const std::vector<std::vector<Splat>> batch{{splat()}};
    Film film(full_size, crop_min, crop_max);
    canvas_.add(batch);
    canvas_.give(film, 1);
    const Image image = film.develop();
    bool is_lit = false;
    for (const float value : image.find("R")->values) is_lit |= value != 0;
    if (is_lit) {
      EXPECT_TRUE(canvas_.is_seen(batch[0][0].p_film));
    }
    if (!canvas_.is_seen(batch[0][0].p_film)) {
      EXPECT_FALSE(is_lit);
    }
  }
}

TEST(Splats, AddToMeansAndVariances) {
  Film film({1, 1}, {0, 0}, {1, 1});
  PathSample sample;
  for (const float L : {1.0f, 3.0f}) {
    sample.L = Rgb(L);
    film.add({0, 0}, sample, 1);
  }
  const double totals[3][3] = {{0, 1, 2}, {0, 3, -2}, {0, 8, 0}};
  for (const auto& total : totals) film.add_splats(total);
  const Image image = film.develop();
  EXPECT_EQ(image.rgb(0, 0), Rgb(2, 6, 2));
  EXPECT_FLOAT_EQ(image.find("variance.R")->values[0], 1);
  EXPECT_FLOAT_EQ(image.find("variance.G")->values[0], 1 + 26.0f / 6);
  EXPECT_FLOAT_EQ(image.find("variance.B")->values[0], 1 + 8.0f / 6);
}

TEST(Splats, NotFiniteOnesAreRejected) {
  Film film({2, 1}, {0, 0}, {2, 1});
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  film.add_splats(std::vector<double>{nan, 1, 1, 1, 2, 3});
  film.add_splats(
      std::vector<double>{1, 1, 1, 1, 2, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(film.rejected().not_a_number, 1);
  EXPECT_EQ(film.rejected().infinite, 1);
  const Image image = film.develop();
  EXPECT_EQ(image.rgb(0, 0), Rgb(0.5f));
  EXPECT_EQ(image.rgb(1, 0), Rgb(0.5f, 1, 1.5f));
}

}  // namespace
}  // namespace tyndall
