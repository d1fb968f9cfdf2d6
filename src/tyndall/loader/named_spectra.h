// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tyndall/math/rgb.h"

namespace tyndall::loader {

/// Spectra that pbrt-v4 knows by name, as RGB: index of refraction and absorption of
/// metals, index of glasses (the same in all channels, at the sodium D line), illuminants
/// of luminance one. Empty if there is none of that name.
std::optional<Rgb> named_spectrum(std::string_view name);

std::vector<std::string_view> spectrum_names();

}  // namespace tyndall::loader
