// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tyndall/loader/color_space.h"

namespace tyndall::loader {
namespace {

struct Xyz {
  double x = 0, y = 0, z = 0;
};

double lobe(double wavelength, double mean, double width_below, double width_above) {
  const double t = (wavelength - mean) / (wavelength < mean ? width_below : width_above);
  return std::exp(-0.5 * t * t);
}

// The CIE 1931 observer, multi-lobe fit of [WSS13].
Xyz observer(double w) {
  return {1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) -
              0.065 * lobe(w, 501.1, 20.4, 26.2),
          0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1),
          1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8)};
}

// CIE illuminant D65 from 380 nm in steps of 10 nm [CIE15].
constexpr std::array<float, 41> d65_values{
    49.98f, 54.65f, 82.75f, 91.49f, 93.43f, 86.68f, 104.9f, 117.0f, 117.8f, 114.9f, 115.9f,
    108.8f, 109.4f, 107.8f, 104.8f, 107.7f, 104.4f, 104.0f, 100.0f, 96.33f, 95.79f, 88.69f,
    90.01f, 89.60f, 87.70f, 83.29f, 83.70f, 80.03f, 80.21f, 82.28f, 78.28f, 69.72f, 71.61f,
    74.35f, 61.60f, 69.89f, 75.09f, 63.59f, 46.42f, 66.81f, 63.38f};
constexpr int first_wavelength = 380, last_wavelength = 780;

double d65(int wavelength) {
  const size_t i = static_cast<size_t>(wavelength - first_wavelength) / 10;
  const double t = (wavelength - first_wavelength) % 10 / 10.0;
  return d65_values[i] * (1 - t) + (t > 0 ? d65_values[i + 1] * t : 0);
}

template <typename F>
Xyz integrate(F&& spectrum) {
  Xyz sum;
  for (int w = first_wavelength; w <= last_wavelength; ++w) {
    const Xyz o = observer(w);
    const double s = spectrum(w);
    sum = {sum.x + s * o.x, sum.y + s * o.y, sum.z + s * o.z};
  }
  return sum;
}

// Relative to luminance `unit`.
Rgb to_rgb(const Xyz& c, double unit) {
  return rec709_from_xyz(static_cast<float>(c.x / unit), static_cast<float>(c.y / unit),
                         static_cast<float>(c.z / unit));
}

const Xyz& daylight() {
  static const Xyz white = integrate([](int w) { return d65(w); });
  return white;
}

// The observer's fit is not exact; dividing by its white makes D65 exactly grey.
Rgb relative_to_white(Rgb color) {
  return clamp_negative(safe_divide(color, to_rgb(daylight(), daylight().y)));
}

}  // namespace

float PiecewiseLinearSpectrum::operator()(float wavelength) const {
  const auto above = std::upper_bound(wavelengths.begin(), wavelengths.end(), wavelength);
  if (above == wavelengths.begin()) return values.front();
  if (above == wavelengths.end()) return values.back();
  const size_t i = static_cast<size_t>(above - wavelengths.begin());
  const float t = (wavelength - wavelengths[i - 1]) / (wavelengths[i] - wavelengths[i - 1]);
  return std::lerp(values[i - 1], values[i], t);
}

SpectrumFunction blackbody(float temperature) {
  constexpr double c2 = 1.438776877e7;     // h c / k [nm K]
  constexpr double peak = 4.965114231744;  // of c2 / (wavelength * temperature), Wien's law
  const double at_peak = std::pow(peak, 5) / std::expm1(peak);
  return [=](float wavelength) {
    const double x = c2 / (double{wavelength} * double{temperature});
    return static_cast<float>(std::pow(x, 5) / std::expm1(x) / at_peak);
  };
}

Rgb rgb_under_daylight(const SpectrumFunction& spectrum) {
  const Xyz color =
      integrate([&](int w) { return spectrum(static_cast<float>(w)) * d65(w); });
  return relative_to_white(to_rgb(color, daylight().y));
}

Rgb rgb_of_light(const SpectrumFunction& spectrum) {
  const Xyz color = integrate([&](int w) { return spectrum(static_cast<float>(w)); });
  if (!(color.y > 0)) return {};
  return relative_to_white(to_rgb(color, color.y));
}

}  // namespace tyndall::loader
