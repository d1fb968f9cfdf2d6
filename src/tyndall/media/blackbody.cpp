// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/blackbody.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace tyndall {
namespace {

constexpr float coldest = 100, hottest = 40000;
constexpr size_t table_size = 2048;

// A piece of the fits of [WSS13]: a Gaussian with different widths to either side.
double lobe(double wavelength, double center, double below, double above) {
  const double x = (wavelength - center) * (wavelength < center ? below : above);
  return std::exp(-0.5 * x * x);
}

// Planck's law relative to its maximum.
double planck(double wavelength, double temperature) {
  constexpr double c2 = 1.438776877e7;     // h c / k [nm K]
  constexpr double peak = 4.965114231744;  // of c2 / (wavelength * temperature), Wien's law
  static const double at_peak = std::pow(peak, 5) / std::expm1(peak);
  const double x = c2 / (wavelength * temperature);
  return std::pow(x, 5) / std::expm1(x) / at_peak;
}

Rgb integrate(double temperature) {
  double x = 0, y = 0, z = 0, white = 0;
  for (double w = 360.5; w < 830; w += 1) {
    const double light = planck(w, temperature);
    const double y_bar =
        0.821 * lobe(w, 568.8, 0.0213, 0.0247) + 0.286 * lobe(w, 530.9, 0.0613, 0.0322);
    x += light *
         (0.362 * lobe(w, 442.0, 0.0624, 0.0374) + 1.056 * lobe(w, 599.8, 0.0264, 0.0323) -
          0.065 * lobe(w, 501.1, 0.0490, 0.0382));
    y += light * y_bar;
    z += light *
         (1.217 * lobe(w, 437.0, 0.0845, 0.0278) + 0.681 * lobe(w, 459.0, 0.0385, 0.0725));
    white += y_bar;
  }
  const auto channel = [&](double a, double b, double c) {
    return static_cast<float>(std::fmax((a * x + b * y + c * z) / white, 0));
  };
  return {channel(3.2404542, -1.5371385, -0.4985314),
          channel(-0.9692660, 1.8760108, 0.0415560),
          channel(0.0556434, -0.2040259, 1.0572252)};
}

using Table = std::array<Rgb, table_size>;

// Equidistant in the logarithm of the temperature.
Table make_table() {
  Table table;
  const double ratio = std::log(double{hottest} / double{coldest});
  for (size_t i = 0; i < table_size; ++i)
    table[i] = integrate(double{coldest} *
                         std::exp(ratio * static_cast<double>(i) / (table_size - 1)));
  return table;
}

}  // namespace

Rgb blackbody_radiance(float temperature) {
  if (!(temperature > coldest)) return Rgb(0);
  static const Table table = make_table();
  static const float scale = (table_size - 1) / std::log(hottest / coldest);
  const float x = std::log(std::fmin(temperature, hottest) / coldest) * scale;
  const size_t i = std::min(static_cast<size_t>(x), table_size - 2);
  const float f = x - static_cast<float>(i);
  return table[i] * (1 - f) + table[i + 1] * f;
}

}  // namespace tyndall
