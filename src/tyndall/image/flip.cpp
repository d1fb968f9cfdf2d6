// SPDX-License-Identifier: Apache-2.0
// FLIP after the two papers [Andersson20], [Andersson21]; equation and section numbers are
// those of the first.
#include "tyndall/image/flip.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "tyndall/image/flip_color.h"
#include "tyndall/image/flip_filter.h"
#include "tyndall/image/tone.h"
#include "tyndall/math/parallel_for.h"

namespace tyndall {
namespace {

using namespace flip;

/// Linear RGB in [0, 1], or the three planes of another space.
using Planes = std::array<Plane, 3>;

/// What the eye makes of one image.
struct Seen {
  Planes colors;  // Hunt-adjusted CIELAB after filtering
  Features features;
};

template <typename F>
void transform_pixels(Planes& planes, F f) {
  for (size_t i = 0; i < planes[0].values.size(); ++i) {
    const Triple out =
        f(Triple{planes[0].values[i], planes[1].values[i], planes[2].values[i]});
    for (size_t c = 0; c < 3; ++c) planes[c].values[i] = static_cast<float>(out[c]);
  }
}

Seen see(Planes planes, double pixels_per_degree) {
  transform_pixels(planes, opponent_from_rgb);
  Plane lightness = planes[0];
  for (float& y : lightness.values) y = (y + 16) / 116;
  planes[0] = filter_by_sensitivity(planes[0], {{1, 0.0047}}, pixels_per_degree);
  planes[1] = filter_by_sensitivity(planes[1], {{1, 0.0053}}, pixels_per_degree);
  planes[2] =
      filter_by_sensitivity(planes[2], {{34.1, 0.04}, {13.5, 0.025}}, pixels_per_degree);
  transform_pixels(planes, [](Triple o) {
    Triple rgb = rgb_from_opponent(o);
    for (double& x : rgb) x = std::clamp(x, 0.0, 1.0);
    return hunt_lab_from_rgb(rgb);
  });
  return {planes, find_features(lightness, pixels_per_degree)};
}

/// Compresses large colour differences into [0, 1] (Sec. 4.1.3); blue against green is the
/// largest.
float redistribute(double difference) {
  constexpr float exponent = 0.7f, knee = 0.4f, knee_value = 0.95f;
  static const float largest = std::pow(
      static_cast<float>(hyab(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1}))),
      exponent);
  const float x = std::pow(static_cast<float>(difference), exponent),
              knee_x = knee * largest;
  if (x < knee_x) return knee_value / knee_x * x;
  return knee_value + (x - knee_x) / (largest - knee_x) * (1 - knee_value);
}

std::vector<float> compare(const Seen& a, const Seen& b) {
  std::vector<float> map(a.colors[0].values.size());
  for (size_t i = 0; i < map.size(); ++i) {
    const auto color = [&](const Seen& s) {
      return Triple{s.colors[0].values[i], s.colors[1].values[i], s.colors[2].values[i]};
    };
    const float color_difference = redistribute(hyab(color(a), color(b)));
    const float edges = std::abs(a.features.edges.values[i] - b.features.edges.values[i]);
    const float points =
        std::abs(a.features.points.values[i] - b.features.points.values[i]);
    const float feature_difference = std::sqrt(std::max(edges, points) / std::sqrt(2.0f));
    map[i] = std::pow(color_difference, 1 - feature_difference);
  }
  return map;
}

/// The pixels of `image` by `tone`: those that are not finite are the reference's, or black
/// if those are not finite either.
template <typename Tone>
Planes display_planes(const Image& image, const Image& reference, Tone tone) {
  const RgbPlanes own = image.rgb_planes(), expected = reference.rgb_planes();
  const Plane zero{image.width(), image.height(), std::vector<float>(image.pixel_count())};
  Planes planes{zero, zero, zero};
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    if (!is_finite(expected[i])) continue;
    const Rgb value = tone(is_finite(own[i]) ? own[i] : expected[i]);
    for (int c = 0; c < 3; ++c) planes[static_cast<size_t>(c)].values[i] = value[c];
  }
  return planes;
}

// The ACES fit of [Narkowicz16] with its pre-exposure of 0.6: the quotient of two quadratic
// polynomials a x^2 + b x (+ c).
constexpr double above_a = 0.36 * 2.51, above_b = 0.6 * 0.03;
constexpr double below_a = 0.36 * 2.43, below_b = 0.6 * 0.59, below_c = 0.14;

float aces(double x) {
  return static_cast<float>(std::clamp(
      (above_a * x + above_b) * x / ((below_a * x + below_b) * x + below_c), 0.0, 1.0));
}

Rgb expose(Rgb L, double factor) {
  const Rgb x = clamp_negative(L);
  return {aces(factor * double{x.r}), aces(factor * double{x.g}),
          aces(factor * double{x.b})};
}

/// The luminance that the curve maps to 0.85.
double luminance_at_85_percent() {
  const double a = above_a - 0.85 * below_a, b = above_b - 0.85 * below_b,
               c = -0.85 * below_c;
  const double p = -0.5 * b / a;
  return p + std::sqrt(p * p - c / a);
}

}  // namespace

std::vector<float> ldr_flip(const Image& image, const Image& reference, float exposure,
                            double pixels_per_degree) {
  const auto see_image = [&](const Image& shown) {
    const auto tone = [&](Rgb L) { return tone_map(L, {.exposure = exposure}); };
    return see(display_planes(shown, reference, tone), pixels_per_degree);
  };
  return compare(see_image(image), see_image(reference));
}

ExposureRange hdr_flip_exposures(const Image& reference) {
  const RgbPlanes planes = reference.rgb_planes();
  std::vector<float> luminances;
  for (size_t i = 0; i < reference.pixel_count(); ++i) {
    if (is_finite(planes[i])) luminances.push_back(std::max(luminance(planes[i]), 0.0f));
  }
  if (luminances.empty()) return {};
  std::sort(luminances.begin(), luminances.end());
  const double median =
      double{luminances[luminances.size() / 2]};  // the upper one, as published
  const double maximum = double{luminances.back()};
  if (maximum <= 0) return {};
  // The published definition needs a median above zero; pictures that are mostly black get
  // 23 stops.
  const double level = luminance_at_85_percent();
  ExposureRange range{std::log2(level / maximum),
                      std::log2(level / std::max(median, 1e-7 * maximum)), 2};
  range.count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
  return range;
}

std::vector<std::vector<float>> hdr_flip(const std::vector<const Image*>& images,
                                         const Image& reference, double pixels_per_degree) {
  const ExposureRange range = hdr_flip_exposures(reference);
  std::vector<std::vector<float>> largest(images.size(),
                                          std::vector<float>(reference.pixel_count()));
  std::mutex mutex;
  const auto look = [&](int i) {
    const double factor =
        std::exp2(range.start + i * (range.stop - range.start) / (range.count - 1));
    const auto see_image = [&](const Image& shown) {
      const auto tone = [&](Rgb L) { return expose(L, factor); };
      return see(display_planes(shown, reference, tone), pixels_per_degree);
    };
    const Seen expected = see_image(reference);
    for (size_t k = 0; k < images.size(); ++k) {
      const std::vector<float> map = compare(see_image(*images[k]), expected);
      const std::lock_guard lock(mutex);
      for (size_t p = 0; p < map.size(); ++p)
        largest[k][p] = std::max(largest[k][p], map[p]);
    }
  };
  // Each exposure holds some twenty planes: a few at a time.
  tbb::task_arena arena(std::min(4, tbb::this_task_arena::max_concurrency()));
  arena.execute([&] { parallel_for(static_cast<size_t>(range.count), look); });
  return largest;
}

std::vector<float> hdr_flip(const Image& image, const Image& reference,
                            double pixels_per_degree) {
  return hdr_flip(std::vector{&image}, reference, pixels_per_degree).front();
}

}  // namespace tyndall
