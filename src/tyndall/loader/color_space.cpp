// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/color_space.h"

#include <array>

namespace tyndall::loader {
namespace {

using Matrix3 = std::array<std::array<float, 3>, 3>;

// From the primaries and whites in CIE 1931 chromaticities: DCI-P3 with D65, [ITU15], and
// ACES2065-1, whose white is adapted to D65 by [Lam85].
constexpr Matrix3 from_dci_p3{{{1.2249402f, -0.2249402f, 0},
                               {-0.042057f, 1.042057f, 0},
                               {-0.0196376f, -0.078636f, 1.0982736f}}};
constexpr Matrix3 from_rec2020{{{1.660491f, -0.5876411f, -0.0728499f},
                                {-0.1245505f, 1.1328999f, -0.0083494f},
                                {-0.0181508f, -0.1005789f, 1.1187297f}}};
constexpr Matrix3 from_aces2065_1{{{2.5216862f, -1.134131f, -0.3875552f},
                                   {-0.2764799f, 1.3727191f, -0.0962392f},
                                   {-0.0153781f, -0.1529753f, 1.1683534f}}};
constexpr Matrix3 from_xyz{{{3.2409699f, -1.5373832f, -0.4986108f},
                            {-0.9692436f, 1.8759675f, 0.0415551f},
                            {0.0556301f, -0.203977f, 1.0569715f}}};

Rgb multiply(const Matrix3& m, Rgb c) {
  const auto row = [&](size_t i) { return m[i][0] * c.r + m[i][1] * c.g + m[i][2] * c.b; };
  return {row(0), row(1), row(2)};
}

}  // namespace

std::optional<ColorSpace> color_space_by_name(std::string_view name) {
  if (name == "srgb") return ColorSpace::srgb;
  if (name == "dci-p3") return ColorSpace::dci_p3;
  if (name == "rec2020") return ColorSpace::rec2020;
  if (name == "aces2065-1") return ColorSpace::aces2065_1;
  return std::nullopt;
}

Rgb rec709_from(ColorSpace space, Rgb color) {
  if (is_grey(color)) return color;  // exactly grey, whatever the rounding of the matrices
  switch (space) {
    case ColorSpace::srgb:
      return color;
    case ColorSpace::dci_p3:
      return multiply(from_dci_p3, color);
    case ColorSpace::rec2020:
      return multiply(from_rec2020, color);
    case ColorSpace::aces2065_1:
      return multiply(from_aces2065_1, color);
  }
  return color;
}

Rgb rec709_from_xyz(float x, float y, float z) { return multiply(from_xyz, {x, y, z}); }

}  // namespace tyndall::loader
