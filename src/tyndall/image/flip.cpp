// SPDX-License-Identifier: Apache-2.0
// FLIP after the two papers [Andersson20], [Andersson21]; equation and section numbers are
// those of the first.
#include "tyndall/image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tyndall/image/tone.h"
#include "tyndall/math/scalar.h"

namespace tyndall {
namespace {

constexpr double pi_d = std::numbers::pi;

/// Three values of a pixel in one of the spaces below.
using Triple = std::array<double, 3>;

/// A plane of numbers.
struct Plane {
  int width, height;
  std::vector<float> values;

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
};

/// Linear RGB in [0, 1], or the three planes of another space.
using Planes = std::array<Plane, 3>;

// sRGB's primaries and white, IEC 61966-2-1, to the digits of exact fractions.
constexpr double xyz_from_rgb[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double rgb_from_xyz[3][3] = {
    {3.241003232976358, -1.537398969488785, -0.498615881996363},
    {-0.969224252202516, 1.875929983695176, 0.041554226340085},
    {0.055639419851975, -0.204011206123910, 1.057148977187533}};
const Triple white = {xyz_from_rgb[0][0] + xyz_from_rgb[0][1] + xyz_from_rgb[0][2],
                      xyz_from_rgb[1][0] + xyz_from_rgb[1][1] + xyz_from_rgb[1][2],
                      xyz_from_rgb[2][0] + xyz_from_rgb[2][1] + xyz_from_rgb[2][2]};

Triple multiply(const double (&m)[3][3], Triple v) {
  Triple result;
  for (size_t i = 0; i < 3; ++i)
    result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

/// Of white 1: XYZ per channel over the white's.
Triple relative_xyz(Triple rgb) {
  Triple xyz = multiply(xyz_from_rgb, rgb);
  for (size_t i = 0; i < 3; ++i) xyz[i] /= white[i];
  return xyz;
}

/// The opponent space in which the eye's contrast sensitivity is applied: linear in RGB,
/// with the scales of CIELAB.
Triple opponent_from_rgb(Triple rgb) {
  const Triple t = relative_xyz(rgb);
  return {116 * t[1] - 16, 500 * (t[0] - t[1]), 200 * (t[1] - t[2])};
}

Triple rgb_from_opponent(Triple o) {
  const double y = (o[0] + 16) / 116;
  return multiply(rgb_from_xyz,
                  {white[0] * (y + o[1] / 500), white[1] * y, white[2] * (y - o[2] / 200)});
}

/// CIELAB, with chroma lowered in the dark (the Hunt effect, Eq. 4).
Triple hunt_lab_from_rgb(Triple rgb) {
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const Triple t = relative_xyz(rgb);
  const double lightness = 116 * f(t[1]) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(t[0]) - f(t[1])),
          0.01 * lightness * 200 * (f(t[1]) - f(t[2]))};
}

/// The HyAB distance, for large colour differences (Eq. 3).
double hyab(Triple a, Triple b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// A symmetric or antisymmetric kernel on [-radius, radius].
using Kernel = std::vector<double>;

template <typename F>
Kernel make_kernel(int radius, F f) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(f(static_cast<double>(i)));
  return kernel;
}

/// to[x] += weight * from[x], written so that compilers vectorize it.
void add_scaled(float* to, const float* from, float weight, size_t n) {
  for (size_t x = 0; x < n; ++x) to[x] += weight * from[x];
}

/// The border pixel continues outside.
Plane convolve_columns(const Plane& in, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Plane out{in.width, in.height, std::vector<float>(in.values.size())};
  for (int y = 0; y < in.height; ++y) {
    for (int i = -radius; i <= radius; ++i) {
      const float* from = &in.values[in.index(0, std::clamp(y + i, 0, in.height - 1))];
      add_scaled(&out.values[out.index(0, y)], from,
                 static_cast<float>(kernel[static_cast<size_t>(i + radius)]),
                 static_cast<size_t>(in.width));
    }
  }
  return out;
}

/// The border pixel continues outside.
Plane convolve_rows(const Plane& in, const Kernel& kernel) {
  const auto radius = static_cast<std::ptrdiff_t>(kernel.size() / 2);
  const auto width = static_cast<size_t>(in.width);
  Plane out{in.width, in.height, std::vector<float>(in.values.size())};
  std::vector<float> padded(width + kernel.size());
  for (int y = 0; y < in.height; ++y) {
    const float* row = &in.values[in.index(0, y)];
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + radius);
    std::fill(padded.begin() + radius + in.width, padded.end(), row[width - 1]);
    for (size_t i = 0; i < kernel.size(); ++i) {
      add_scaled(&out.values[out.index(0, y)], &padded[i], static_cast<float>(kernel[i]),
                 width);
    }
  }
  return out;
}

Plane convolve(const Plane& in, const Kernel& x, const Kernel& y) {
  return convolve_columns(convolve_rows(in, x), y);
}

double total(const Kernel& kernel) {
  double sum = 0;
  for (double k : kernel) sum += k;
  return sum;
}

Kernel scaled(Kernel kernel, double factor) {
  for (double& k : kernel) k *= factor;
  return kernel;
}

/// One Gaussian of a contrast sensitivity function, a sqrt(pi / b) exp(-pi^2 x^2 / b) in
/// the distance x [degrees] (Table 1).
struct Sensitivity {
  double a, b;
};

constexpr double widest_b = 0.04;

/// Filters as the eye does at a distance (Sec. 4.1.1). A sum of two Gaussians is not
/// separable, each of them is; together they have unit sum.
Plane filter_by_sensitivity(const Plane& in, std::vector<Sensitivity> terms,
                            double pixels_per_degree) {
  const int radius = static_cast<int>(
      std::ceil(3 * std::sqrt(widest_b / (2 * pi_d * pi_d)) * pixels_per_degree));
  std::vector<Kernel> kernels;
  std::vector<double> weights;
  double weight_sum = 0;
  for (const Sensitivity& term : terms) {
    kernels.push_back(make_kernel(radius, [&](double i) {
      return std::exp(-pi_d * pi_d * sqr(i / pixels_per_degree) / term.b);
    }));
    weights.push_back(term.a * std::sqrt(pi_d / term.b));
    weight_sum += weights.back() * sqr(total(kernels.back()));
  }
  Plane out{in.width, in.height, std::vector<float>(in.values.size())};
  for (size_t t = 0; t < terms.size(); ++t) {
    const Plane part =
        convolve(in, scaled(kernels[t], weights[t] / weight_sum), kernels[t]);
    for (size_t i = 0; i < out.values.size(); ++i) out.values[i] += part.values[i];
  }
  return out;
}

/// The strengths of edges and of points in the lightness of an image (Sec. 4.2.1).
struct Features {
  Plane edges, points;
};

/// Makes the positive weights sum to one and the negative ones to minus one.
Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (double k : kernel) (k > 0 ? positive : negative) += std::abs(k);
  for (double& k : kernel) k /= k > 0 ? positive : negative;
  return kernel;
}

Plane magnitude(const Plane& dx, const Plane& dy) {
  Plane result = dx;
  for (size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = std::hypot(dx.values[i], dy.values[i]);
  }
  return result;
}

Features find_features(const Plane& lightness, double pixels_per_degree) {
  constexpr double feature_width = 0.082;  // [degrees]
  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto gauss = [&](double x) { return std::exp(-0.5 * sqr(x / sigma)); };
  const Kernel blur = make_kernel(radius, gauss);
  const Kernel smooth = scaled(blur, 1 / total(blur));
  const Kernel first =
      balanced(make_kernel(radius, [&](double x) { return -x * gauss(x); }));
  const Kernel second = balanced(
      make_kernel(radius, [&](double x) { return (sqr(x / sigma) - 1) * gauss(x); }));
  return {
      magnitude(convolve(lightness, first, smooth), convolve(lightness, smooth, first)),
      magnitude(convolve(lightness, second, smooth), convolve(lightness, smooth, second))};
}

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
double redistribute(double difference) {
  constexpr double exponent = 0.7, knee = 0.4, knee_value = 0.95;
  static const double largest =
      std::pow(hyab(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1})), exponent);
  const double x = std::pow(difference, exponent), knee_x = knee * largest;
  if (x < knee_x) return knee_value / knee_x * x;
  return knee_value + (x - knee_x) / (largest - knee_x) * (1 - knee_value);
}

std::vector<float> flip_of_display_images(const Planes& image, const Planes& reference,
                                          double pixels_per_degree) {
  const Seen a = see(reference, pixels_per_degree), b = see(image, pixels_per_degree);
  std::vector<float> map(image[0].values.size());
  for (size_t i = 0; i < map.size(); ++i) {
    const auto color = [&](const Seen& s) {
      return Triple{s.colors[0].values[i], s.colors[1].values[i], s.colors[2].values[i]};
    };
    const double color_difference = redistribute(hyab(color(a), color(b)));
    const float edges = std::abs(a.features.edges.values[i] - b.features.edges.values[i]);
    const float points =
        std::abs(a.features.points.values[i] - b.features.points.values[i]);
    const double feature_difference =
        std::sqrt(double{std::max(edges, points)} / std::sqrt(2.0));
    map[i] = static_cast<float>(std::pow(color_difference, 1 - feature_difference));
  }
  return map;
}

/// The pixels of `image` by `tone`, those that are not finite in either image black.
template <typename Tone>
Planes display_planes(const Image& image, const Image& other, Tone tone) {
  const RgbPlanes own = image.rgb_planes(), others = other.rgb_planes();
  const Plane zero{image.width(), image.height(), std::vector<float>(image.pixel_count())};
  Planes planes{zero, zero, zero};
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    if (!is_finite(own[i]) || !is_finite(others[i])) continue;
    const Rgb value = tone(own[i]);
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
  const auto tone = [&](Rgb L) { return tone_map(L, {.exposure = exposure}); };
  return flip_of_display_images(display_planes(image, reference, tone),
                                display_planes(reference, image, tone), pixels_per_degree);
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

std::vector<float> hdr_flip(const Image& image, const Image& reference,
                            double pixels_per_degree) {
  const ExposureRange range = hdr_flip_exposures(reference);
  std::vector<float> largest(image.pixel_count());
  for (int i = 0; i < range.count; ++i) {
    const double factor =
        std::exp2(range.start + i * (range.stop - range.start) / (range.count - 1));
    const auto tone = [&](Rgb L) {
      const Rgb x = clamp_negative(L);
      return Rgb(aces(factor * double{x.r}), aces(factor * double{x.g}),
                 aces(factor * double{x.b}));
    };
    const std::vector<float> map =
        flip_of_display_images(display_planes(image, reference, tone),
                               display_planes(reference, image, tone), pixels_per_degree);
    for (size_t p = 0; p < map.size(); ++p) largest[p] = std::max(largest[p], map[p]);
  }
  return largest;
}

}  // namespace tyndall
