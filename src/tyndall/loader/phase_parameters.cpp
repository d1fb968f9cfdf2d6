// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/medium_parameters.h"

namespace tyndall::loader {
namespace {

constexpr Range mean_cosines{-1, 1, true};

PhaseFunction make_hg(ParameterSet& p) {
  const float g = p.number("g", 0, mean_cosines);
  if (g == 0) return IsotropicPhase{};
  return HenyeyGreenstein{g};
}

PhaseFunction make_two_lobes(ParameterSet& p) {
  const HenyeyGreenstein first(p.number("g", 0, mean_cosines));
  const HenyeyGreenstein second(p.number("g2", 0, mean_cosines));
  return TwoLobePhase(first, second, p.number("share", 0.5f, {0, 1}));
}

PhaseFunction make_rayleigh(ParameterSet& /*p*/) { return RayleighPhase{}; }

PhaseFunction make_tabulated(ParameterSet& p) {
  const std::vector<float> values = p.numbers("values");
  const bool are_valid =
      std::ranges::all_of(values, [](float v) { return v >= 0 && std::isfinite(v); });
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  if (values.size() >= 2 && are_valid && sum > 0 && sum < 1e30)
    return TabulatedPhase(values);
  p.error(p.has("values") ? "values" : "phase",
          "\"values\" must be two or more numbers that are not negative and not all zero: "
          "the phase function at equidistant cosines from -1 (back) to 1 (straight on)");
  return IsotropicPhase{};
}

struct PhaseType {
  std::string_view name;
  PhaseFunction (*make)(ParameterSet&);
};

constexpr std::array phase_types{
    PhaseType{"hg", make_hg},
    PhaseType{"two-lobe-hg", make_two_lobes},
    PhaseType{"rayleigh", make_rayleigh},
    PhaseType{"tabulated", make_tabulated},
};

}  // namespace

PhaseFunction read_phase_function(ParameterSet& parameters) {
  const std::string name = parameters.string("phase", "hg");
  std::vector<std::string_view> names;
  for (const PhaseType& known : phase_types) {
    if (known.name == name) return known.make(parameters);
    names.push_back(known.name);
  }
  parameters.error("phase", fmt::format("there is no phase function \"{}\"{}", name,
                                        did_you_mean(name, names)));
  parameters.ignore({"g", "g2", "share", "values"});
  return IsotropicPhase{};
}

}  // namespace tyndall::loader
