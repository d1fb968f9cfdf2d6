// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/connection_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
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

// What `--set` says of an option. Throws std::invalid_argument if that is something else.
struct OptionValue {
  const std::string& name;
  const std::string& text;

  bool is_on() const {
    if (text == "on") return true;
    if (text == "off") return false;
    throw std::invalid_argument(
        fmt::format("option \"{}\" is \"on\" or \"off\", not \"{}\"", name, text));
  }
  size_t bytes() const {  // given in MB
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || rest != end || !(number > 0 && number <= most_megabytes))
      throw std::invalid_argument(
          fmt::format("option \"{}\" is a positive number of MB, not \"{}\"", name, text));
    return static_cast<size_t>(1e6 * number);
  }

  static constexpr double most_megabytes = 1e12;
};

using SetOption = void (*)(ConnectionSettings&, const OptionValue&);
using KnownOptions = std::map<std::string_view, SetOption>;

template <bool ConnectionSettings::*Member>
void set_switch(ConnectionSettings& settings, const OptionValue& value) {
  settings.*Member = value.is_on();
}

void set_lit_surfaces(ConnectionSettings& settings, const OptionValue& value) {
  if (!value.is_on()) settings.lit_surfaces = 0;
}

void set_memory(ConnectionSettings& settings, const OptionValue& value) {
  settings.direction_memory = value.bytes();
}

// Those of what is learned begin with "learned" and a dot.
const KnownOptions& options_of(const std::string& integrator) {
  using S = ConnectionSettings;
  static const KnownOptions plain{{"particles", set_switch<&S::particles>}};
  static const KnownOptions zhou2016{{"particles", set_switch<&S::particles>},
                                     {"learned.product", set_switch<&S::product>},
                                     {"learned.pretraining", set_switch<&S::pretraining>},
                                     {"learned.memory", set_memory}};
  static const KnownOptions learned{{"particles", set_switch<&S::particles>},
                                    {"learned.direction", set_switch<&S::direction>},
                                    {"learned.product", set_switch<&S::product>},
                                    {"learned.pretraining", set_switch<&S::pretraining>},
                                    {"learned.memory", set_memory},
                                    {"learned.roulette", set_switch<&S::roulette>},
                                    {"learned.sky", set_switch<&S::sky_directions>},
                                    {"learned.distance", set_switch<&S::visibility>},
                                    {"learned.lit_surfaces", set_lit_surfaces}};
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
    if (options_of(other.first).contains(name)) owners.emplace_back(other.first);
  if (!owners.empty()) return fmt::format("; it belongs to {}", quoted_list(owners));
  const std::vector<std::string_view> names = keys_of(options_of(integrator));
  for (const std::string_view n : names) short_names.push_back(short_name(n));
  const std::string_view nearest = nearest_name(short_name(name), short_names);
  for (const std::string_view n : names)
    if (!nearest.empty() && short_name(n) == nearest)
      return fmt::format("; did you mean \"{}\"?", n);
  return fmt::format("; there are: {}", fmt::join(names, ", "));
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
  const KnownOptions& known = options_of(integrator);
  for (const auto& [name, value] : options) {
    const auto entry = known.find(name);
    if (entry == known.end())
      throw std::invalid_argument(fmt::format("integrator \"{}\" has no option \"{}\"{}",
                                              integrator, name, hint(integrator, name)));
    entry->second(settings, {name, value});
  }
  return settings;
}

}  // namespace tyndall
