// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tyndall/math/rgb.h"

namespace tyndall::loader {

/// Measured coefficients of a liquid or translucent solid [1/mm].
struct MediumPreset {
  std::string_view name;
  Rgb sigma_s, sigma_a;
};

/// Empty if there is none of that name.
std::optional<MediumPreset> medium_preset(std::string_view name);

std::vector<std::string_view> medium_preset_names();

}  // namespace tyndall::loader
