// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/named_spectra.h"

#include <algorithm>
#include <array>

#include "tyndall/loader/color_space.h"

namespace tyndall::loader {
namespace {

struct Entry {
  std::string_view name;
  Rgb value;
};

constexpr Rgb grey(float x) { return {x, x, x}; }

// Three numbers cannot hold a spectrum. Those of a metal are chosen so that a mirror of it
// reflects D65 at normal incidence with the color that its spectra give, at most 0.99 (gold
// leaves the gamut): eta at the dominant wavelengths of the Rec. 709 primaries,
// 611, 549 and 465 nm, and k, or eta where k is zero, solved for the reflectance. Spectra
// from [Luxpop26], the same in pbrt-v4 and Mitsuba 3; brass is Cu70Zn30 of [Querry85].
// Glasses at 587.6 nm from Schott's catalogue; pbrt-v4 calls SF5 F5, and so on.
constexpr std::array materials{
    Entry{"glass-BK7", grey(1.5168f)},
    Entry{"glass-BAF10", grey(1.6700f)},
    Entry{"glass-FK51A", grey(1.4866f)},
    Entry{"glass-LASF9", grey(1.8503f)},
    Entry{"glass-F5", grey(1.6727f)},
    Entry{"glass-F10", grey(1.7283f)},
    Entry{"glass-F11", grey(1.7847f)},
    Entry{"glass-SF5", grey(1.6727f)},
    Entry{"glass-SF10", grey(1.7283f)},
    Entry{"glass-SF11", grey(1.7847f)},
    Entry{"metal-Ag-eta", {0.128f, 0.125f, 0.140f}},
    Entry{"metal-Ag-k", {4.083f, 3.351f, 2.301f}},
    Entry{"metal-Al-eta", {1.253f, 0.954f, 0.660f}},
    Entry{"metal-Al-k", {7.255f, 6.694f, 5.676f}},
    Entry{"metal-Au-eta", {0.205f, 0.355f, 1.372f}},
    Entry{"metal-Au-k", {8.971f, 2.166f, 1.653f}},
    Entry{"metal-Cu-eta", {0.319f, 0.966f, 1.157f}},
    Entry{"metal-Cu-k", {5.178f, 2.607f, 2.317f}},
    Entry{"metal-CuZn-eta", {0.452f, 0.529f, 0.947f}},
    Entry{"metal-CuZn-k", {4.230f, 2.683f, 1.666f}},
    Entry{"metal-MgO-eta", {1.734f, 1.741f, 1.754f}},
    Entry{"metal-MgO-k", grey(0)},
    Entry{"metal-TiO2-eta", {2.860f, 2.957f, 3.186f}},
    Entry{"metal-TiO2-k", grey(0)},
};

struct Illuminant {
  std::string_view name;
  float x, y;  // CIE 1931 chromaticity
};

// [CIE15], except ACES's white.
constexpr std::array illuminants{
    Illuminant{"stdillum-A", 0.44757f, 0.40745f},
    Illuminant{"stdillum-D50", 0.34567f, 0.35850f},
    Illuminant{"stdillum-D55", 0.33242f, 0.34743f},
    Illuminant{"stdillum-D65", 0.31270f, 0.32900f},
    Illuminant{"stdillum-D75", 0.29902f, 0.31485f},
    Illuminant{"stdillum-F1", 0.31310f, 0.33727f},
    Illuminant{"stdillum-F2", 0.37208f, 0.37529f},
    Illuminant{"stdillum-F3", 0.40910f, 0.39430f},
    Illuminant{"stdillum-F4", 0.44018f, 0.40329f},
    Illuminant{"stdillum-F5", 0.31379f, 0.34531f},
    Illuminant{"stdillum-F6", 0.37790f, 0.38835f},
    Illuminant{"stdillum-F7", 0.31292f, 0.32933f},
    Illuminant{"stdillum-F8", 0.34588f, 0.35875f},
    Illuminant{"stdillum-F9", 0.37417f, 0.37281f},
    Illuminant{"stdillum-F10", 0.34609f, 0.35986f},
    Illuminant{"stdillum-F11", 0.38052f, 0.37713f},
    Illuminant{"stdillum-F12", 0.43695f, 0.40441f},
    Illuminant{"illum-acesD60", 0.32168f, 0.33767f},
};

}  // namespace

std::optional<Rgb> named_spectrum(std::string_view name) {
  for (const Entry& entry : materials)
    if (entry.name == name) return entry.value;
  for (const Illuminant& light : illuminants)
    if (light.name == name)
      return clamp_negative(
          rec709_from_xyz(light.x / light.y, 1, (1 - light.x - light.y) / light.y));
  return std::nullopt;
}

std::vector<std::string_view> spectrum_names() {
  std::vector<std::string_view> names;
  names.reserve(std::size(materials) + std::size(illuminants));
  for (const Entry& entry : materials) names.push_back(entry.name);
  for (const Illuminant& light : illuminants) names.push_back(light.name);
  return names;
}

}  // namespace tyndall::loader
