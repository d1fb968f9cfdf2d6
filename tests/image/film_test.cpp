// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <thread>

namespace tyndall {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Film film_of(int width, int height) {
  return Film({width, height}, {0, 0}, {width, height});
}

PathSample sample_of(Rgb L) {
  PathSample sample;
  sample.L = L;
  return sample;
}

float value(const Image& image, const std::string& channel, size_t pixel = 0) {
  return image.find(channel)->values[pixel];
}

// A mean far above the spread is where the sum of squares minus the squared sum fails.
TEST(FilmTest, MeanAndVarianceMatchTwoPasses) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> offset(0, 1);
  std::vector<double> values;
  Film film = film_of(1, 1);
  for (int i = 0; i < 5000; ++i) {
    const float L = static_cast<float>(1e4 + offset(random));
    const float weight = i % 5 == 0 ? -0.25f : 1.25f;
    values.push_back(static_cast<double>(weight) * static_cast<double>(L));
    film.add({0, 0}, sample_of({L, 0, 2 * L}), weight);
  }
  double mean = 0, squares = 0;
  const auto n = static_cast<double>(values.size());
  for (double v : values) mean += v / n;
  for (double v : values) squares += (v - mean) * (v - mean);
  const double variance = squares / (n - 1) / n;

  const Image image = film.develop();
  EXPECT_NEAR(value(image, "R"), mean, 1e-6 * mean);
  EXPECT_NEAR(value(image, "variance.R"), variance, 1e-6 * variance);
  EXPECT_NEAR(value(image, "variance.B"), 4 * variance, 4e-6 * variance);
  EXPECT_EQ(value(image, "variance.G"), 0);
  EXPECT_EQ(value(image, "spp.Y"), 5000);
}

TEST(FilmTest, MeanKeepsMovingAfterAMillionSamples) {
  Film film = film_of(1, 1);
  const int half = 1 << 20;
  for (int i = 0; i < half; ++i) film.add({0, 0}, sample_of(Rgb(1)), 1);
  for (int i = 0; i < half; ++i) film.add({0, 0}, sample_of(Rgb(1.001f)), 1);
  EXPECT_NEAR(value(film.develop(), "R"), (1 + double{1.001f}) / 2, 1e-7);
}

TEST(FilmTest, RefusesAndCountsWhatIsNoRadiance) {
  Film film = film_of(2, 1);
  const float inf = std::numeric_limits<float>::infinity();
  film.add({0, 0}, sample_of({1, nan, inf}), 1);
  film.add({0, 0}, sample_of({1, inf, -1}), 1);
  film.add({1, 0}, sample_of({1, -inf, 1}), 1);
  film.add({1, 0}, sample_of({1, 1, -1e-20f}), 1);
  film.add({1, 0}, sample_of({4, -0.0f, 2}), 1);
  EXPECT_EQ(film.rejected().not_a_number, 1);
  EXPECT_EQ(film.rejected().infinite, 2);
  EXPECT_EQ(film.rejected().negative, 1);
  EXPECT_EQ(film.rejected().total(), 4);
  const Image image = film.develop();
  EXPECT_EQ(image.rgb(0, 0), Rgb(0));
  EXPECT_EQ(image.rgb(1, 0),
            Rgb(4.0f / 3, 0, 2.0f / 3));  // rejected samples count as black
  EXPECT_EQ(value(image, "spp.Y", 1), 3);
}

TEST(FilmTest, OneSampleHasNoVariance) {
  Film film = film_of(1, 1);
  EXPECT_EQ(value(film.develop(), "spp.Y"), 0);
  film.add({0, 0}, sample_of(Rgb(3)), 1);
  EXPECT_EQ(value(film.develop(), "R"), 3);
  EXPECT_EQ(value(film.develop(), "variance.R"), 0);
}

TEST(FilmTest, AveragesGuidesWithoutWeights) {
  Film film = film_of(1, 1);
  film.add({0, 0}, {Rgb(1), {0.2f, 0.4f, 0.6f}, {0, 0, 1}, 10}, 2);
  film.add({0, 0}, {Rgb(1), {0.4f, 0.4f, 0.2f}, {1, 0, 0}, 20}, -1);
  film.add({0, 0}, {Rgb(1), Rgb(nan), {nan, 0, 0}, nan}, 1);
  film.add({0, 0}, {Rgb(1), Rgb(0), {0, 0, 0}, 0}, 1);
  const Image image = film.develop();
  EXPECT_FLOAT_EQ(value(image, "albedo.R"), 0.15f);
  EXPECT_FLOAT_EQ(value(image, "normal.X"), 0.25f);
  EXPECT_FLOAT_EQ(value(image, "normal.Z"), 0.25f);
  EXPECT_FLOAT_EQ(value(image, "depth.Z"), 15);  // of the two samples that hit something
}

TEST(FilmTest, PixelWithoutSamplesShowsOneNearby) {
  Film film = film_of(3, 1);
  film.add({1, 0}, {Rgb(1), Rgb(0.5f), {0, 0, 1}, 10}, 1);
  film.add({1, 0}, {Rgb(3), Rgb(0.5f), {0, 0, 1}, 10}, 1);
  film.add({2, 0}, {Rgb(7), Rgb(0.25f), {0, 1, 0}, 20}, 1);
  EXPECT_EQ(film.unsampled(), 1);
  const Image image = film.develop();
  EXPECT_EQ(image.find("spp.Y")->values, (std::vector<float>{0, 2, 1}));
  for (const Channel& channel : image.channels()) {
    if (channel.name != "spp.Y") {
      EXPECT_EQ(channel.values[0], channel.values[1]);
    }
  }
  EXPECT_EQ(image.rgb(0, 0), Rgb(2));
}

TEST(FilmTest, CropKnowsItsPlace) {
  Film film({100, 50}, {10, 20}, {14, 22});
  film.add({13, 21}, sample_of(Rgb(5)), 1);
  const Image image = film.develop();
  EXPECT_EQ(image.width(), 4);
  EXPECT_EQ(image.height(), 2);
  EXPECT_EQ(image.offset, (Vec2i{10, 20}));
  EXPECT_EQ(image.full_size, (Vec2i{100, 50}));
  EXPECT_EQ(image.rgb(3, 1), Rgb(5));
}

// Fails under the thread sanitizer if neighbouring pixels share anything.
TEST(FilmTest, ThreadsMayAddToDifferentPixels) {
  const int width = 64;
  Film film = film_of(width, 1);
  const auto work = [&](int first) {
    for (int i = 0; i < 1000; ++i) {
      for (int x = first; x < width; x += 2) {
        film.add({x, 0}, sample_of(Rgb(i % 2 ? static_cast<float>(x) : nan)), 1);
      }
    }
  };
  std::thread even(work, 0), odd(work, 1);
  even.join();
  odd.join();
  EXPECT_EQ(film.rejected().not_a_number, 500 * width);
  for (int x = 0; x < width; ++x) {
    EXPECT_EQ(film.develop().rgb(x, 0), Rgb(static_cast<float>(x) / 2));
  }
}

}  // namespace
}  // namespace tyndall
