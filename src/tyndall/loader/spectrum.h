// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "tyndall/loader/files.h"
#include "tyndall/loader/parameter_set.h"
#include "tyndall/math/rgb.h"

namespace tyndall::loader {

/// What a spectrum parameter stands for; decides how it becomes RGB and what it may be.
enum class SpectrumUse {
  reflectance,  ///< in [0, 1]; seen under D65
  coefficient,  ///< not negative; seen under D65
  /// As pbrt-v4 normalizes lights: an rgb is taken as it stands, all other spectra are
  /// scaled to luminance one.
  illuminant,
};

/// A spectrum as function of the wavelength [nm].
using SpectrumFunction = std::function<float(float)>;

/// Linear between the points, constant beyond the ends. Preconditions: not empty,
/// wavelengths ascending.
struct PiecewiseLinearSpectrum {
  std::vector<float> wavelengths;  ///< [nm]
  std::vector<float> values;

  float operator()(float wavelength) const;
};

/// Planck's law, scaled to a maximum of one. Precondition: temperature > 0 [K].
SpectrumFunction blackbody(float temperature);

/// The color of a reflectance or coefficient under D65: constants map to grey. Components
/// that would be negative (colors outside the gamut) are zero.
Rgb rgb_under_daylight(const SpectrumFunction& spectrum);
/// The color of a light of this spectrum with luminance one; black if it has no luminance.
Rgb rgb_of_light(const SpectrumFunction& spectrum);

/// A spectrum parameter: rgb, spectrum (pairs, name or file), blackbody, or a plain float.
/// Empty if it is not given.
std::optional<Rgb> spectrum_parameter(ParameterSet& parameters, std::string_view name,
                                      SpectrumUse use, const FileFinder& files);

}  // namespace tyndall::loader
