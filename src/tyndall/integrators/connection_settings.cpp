// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/connection_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string_view>
#include <utility>

#include "tyndall/integrators/lit_surface.h"
#include "tyndall/integrators/nearest_name.h"

namespace tyndall {
namespace {

const std::vector<std::pair<std::string, ConnectionSettings>>& integrators() {
  static const std::vector<std::pair<std::string, ConnectionSettings>> all{
      {"volpath", {}},
      {"equiangular", {.single = true}},
      {"jis", {.single = true, .dual = true}},
      {"learned",
       {.single = true,
        .dual = true,
        .min_distance_ratio = 1,
        .visibility = true,
        .lit_surfaces = max_lit_surfaces,
        .roulette = true,
        .direction = true}},
      {"zhou2016",
       {.single = true, .dual = true, .min_distance_ratio = 1, .direction = true}}};
  return all;
}

using Switch = void (*)(ConnectionSettings&, bool is_on);
using Switches = std::map<std::string_view, Switch>;

const Switches::value_type particles{
    "particles", [](ConnectionSettings& s, bool is_on) { s.particles = is_on; }};

// What can be turned off: parts of what is learned by "learned" and a dot.
const Switches& switches_of(const std::string& integrator) {
  static const Switches plain{particles};
  static const Switches zhou2016{
      particles,
      {"learned.product", [](ConnectionSettings& s, bool is_on) { s.product = is_on; }},
      {"learned.pretraining",
       [](ConnectionSettings& s, bool is_on) { s.pretraining = is_on; }}};
  static const Switches learned{
      particles,
      {"learned.direction", [](ConnectionSettings& s, bool is_on) { s.direction = is_on; }},
      {"learned.product", [](ConnectionSettings& s, bool is_on) { s.product = is_on; }},
      {"learned.pretraining",
       [](ConnectionSettings& s, bool is_on) { s.pretraining = is_on; }},
      {"learned.roulette", [](ConnectionSettings& s, bool is_on) { s.roulette = is_on; }},
      {"learned.sky", [](ConnectionSettings& s, bool is_on) { s.sky_directions = is_on; }},
      {"learned.distance", [](ConnectionSettings& s, bool is_on) { s.visibility = is_on; }},
      {"learned.lit_surfaces", [](ConnectionSettings& s, bool is_on) {
         if (!is_on) s.lit_surfaces = 0;
       }}};
  if (integrator == "learned") return learned;
  return integrator == "zhou2016" ? zhou2016 : plain;
}

// Without the part up to the dot.
std::string_view short_name(std::string_view name) {
  return name.substr(name.rfind('.') + 1);
}

// What options that do not exist could have meant: a name that is near once the part before
// the dot, which all share, is left out; the integrators that have it; else all there are.
std::string hint(const std::string& integrator, const std::string& name) {
  std::vector<std::string_view> owners, short_names;
  for (const auto& other : integrators())
    if (switches_of(other.first).contains(name)) owners.emplace_back(other.first);
  if (!owners.empty()) return fmt::format("; it belongs to {}", quoted_list(owners));
  const std::vector<std::string_view> names = keys_of(switches_of(integrator));
  for (const std::string_view n : names) short_names.push_back(short_name(n));
  const std::string_view nearest = nearest_name(short_name(name), short_names);
  for (const std::string_view n : names)
    if (!nearest.empty() && short_name(n) == nearest)
      return fmt::format("; did you mean \"{}\"?", n);
  return fmt::format("; there are: {}", fmt::join(names, ", "));
}

bool parse_switch(const std::string& name, const std::string& value) {
  if (value == "on") return true;
  if (value == "off") return false;
  throw std::invalid_argument(
      fmt::format("option \"{}\" is \"on\" or \"off\", not \"{}\"", name, value));
}

}  // namespace

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const auto& entry : integrators()) names.push_back(entry.first);
  return names;
}

ConnectionSettings connection_settings(const std::string& integrator,
                                       const std::map<std::string, std::string>& options) {
  const ConnectionSettings* found = nullptr;
  for (const auto& [name, settings] : integrators())
    if (name == integrator) found = &settings;
  if (!found)
    throw std::invalid_argument(fmt::format("unknown integrator \"{}\"; there are: {}",
                                            integrator,
                                            fmt::join(integrator_names(), ", ")));
  ConnectionSettings settings = *found;
  const Switches& switches = switches_of(integrator);
  for (const auto& [name, value] : options) {
    const auto entry = switches.find(name);
    if (entry == switches.end())
      throw std::invalid_argument(fmt::format("integrator \"{}\" has no option \"{}\"{}",
                                              integrator, name, hint(integrator, name)));
    entry->second(settings, parse_switch(name, value));
  }
  return settings;
}

}  // namespace tyndall
