// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/flip_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tyndall/math/scalar.h"

namespace tyndall::flip {
namespace {

constexpr double pi_d = std::numbers::pi;

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

constexpr double widest_b = 0.04;  // of the sensitivities in [Andersson20, Table 1]

}  // namespace

Plane filter_by_sensitivity(const Plane& in, const std::vector<Sensitivity>& terms,
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

}  // namespace tyndall::flip
