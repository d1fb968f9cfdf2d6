// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tyndall/loader/source_library.h"
#include "tyndall/math/rgb.h"

namespace tyndall::loader {

/// A square equal-area picture of all directions.
struct EnvironmentPicture {
  int resolution = 0;
  std::vector<Rgb> pixels;  ///< row 0 first, finite and not negative

  /// On a surface that faces the picture's +z, for which pbrt-v4 states "illuminance".
  float illuminance() const;
};

/// Throws Failure at `where` if the picture cannot be read or is not square. Pixels that
/// are not finite or negative become black.
EnvironmentPicture read_environment(const std::string& path, Span where);

}  // namespace tyndall::loader
