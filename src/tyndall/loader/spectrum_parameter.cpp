// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/color_space.h"
#include "tyndall/loader/named_spectra.h"
#include "tyndall/loader/numbers.h"
#include "tyndall/loader/spectrum.h"

namespace tyndall::loader {
namespace {

Rgb to_rgb(const SpectrumFunction& spectrum, SpectrumUse use) {
  return use == SpectrumUse::illuminant ? rgb_of_light(spectrum)
                                        : rgb_under_daylight(spectrum);
}

// Wavelengths and values in turn.
Rgb from_pairs(const Parameter& p, const std::vector<float>& pairs, SpectrumUse use) {
  if (pairs.empty() || pairs.size() % 2 != 0)
    fail(
        p.where,
        fmt::format("a spectrum is a list of wavelengths with a value each; got {} numbers",
                    pairs.size()));
  PiecewiseLinearSpectrum spectrum;
  for (size_t i = 0; i < pairs.size(); i += 2) {
    if (i > 0 && !(pairs[i] > pairs[i - 2]))
      fail(p.where, fmt::format("wavelengths of a spectrum must ascend, got {} after {}",
                                pairs[i], pairs[i - 2]));
    if (pairs[i + 1] < 0)
      fail(p.where, fmt::format("a spectrum must not be negative, got {} at {} nm",
                                pairs[i + 1], pairs[i]));
    spectrum.wavelengths.push_back(pairs[i]);
    spectrum.values.push_back(pairs[i + 1]);
  }
  const bool is_constant = std::equal(spectrum.values.begin() + 1, spectrum.values.end(),
                                      spectrum.values.begin());
  if (is_constant && use != SpectrumUse::illuminant) return Rgb(spectrum.values[0]);
  return to_rgb(spectrum, use);
}

// The numbers of a .spd file: white space between, # begins a comment.
std::vector<float> numbers_of_file(const Parameter& p, const std::string& path) {
  std::string text;
  try {
    text = read_bytes(path);
  } catch (const std::runtime_error& error) {
    fail(p.where, fmt::format("cannot read \"{}\": {}", path, error.what()));
  }
  std::vector<float> numbers;
  constexpr std::string_view blanks = " \t\r\n";
  for (size_t at = 0; (at = text.find_first_not_of(blanks, at)) != text.npos;) {
    if (text[at] == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    const size_t end = std::min(text.find_first_of(blanks, at), text.size());
    const std::string_view word = std::string_view(text).substr(at, end - at);
    if (parse_number(word, numbers.emplace_back()) != NumberError::none)
      fail(p.where, fmt::format("\"{}\" holds \"{}\" where a number is expected", path,
                                word.substr(0, 40)));
    at = end;
  }
  return numbers;
}

Rgb from_name(const Parameter& p, SpectrumUse use, const FileFinder& files) {
  const std::string& name = p.strings[0];
  if (const auto named = named_spectrum(name)) return *named;
  const bool is_path = name.find_first_of("./") != name.npos;
  if (!is_path)
    fail(p.where, fmt::format("there is no spectrum named \"{}\"{}", name,
                              did_you_mean(name, spectrum_names())));
  return from_pairs(p, numbers_of_file(p, files.find(name, p.where)), use);
}

Rgb from_rgb(const Parameter& p, SpectrumUse use) {
  const Rgb color{p.numbers[0], p.numbers[1], p.numbers[2]};
  if (min_component(color) < 0)
    fail(p.where, fmt::format("\"rgb {}\" must not be negative, got {} {} {}", p.name,
                              color.r, color.g, color.b));
  if (use == SpectrumUse::reflectance && max_component(color) > 1)
    fail(p.where, fmt::format("\"rgb {}\" must lie in [0, 1], got {} {} {}", p.name,
                              color.r, color.g, color.b));
  return clamp_negative(rec709_from(p.color_space, color));
}

Rgb from_blackbody(const Parameter& p, SpectrumUse use) {
  if (!(p.numbers[0] > 0))
    fail(p.where, fmt::format("the temperature of a blackbody must be positive, got {}",
                              p.numbers[0]));
  return to_rgb(blackbody(p.numbers[0]), use);
}

Rgb from_number(const Parameter& p) {
  if (p.numbers[0] < 0)
    fail(p.where, fmt::format("\"{}\" must not be negative, got {}", p.name, p.numbers[0]));
  return Rgb(p.numbers[0]);
}

void check_count(const Parameter& p) {
  const size_t count = p.numbers.size() + p.strings.size();
  const size_t expected = p.type == ParameterType::rgb ? 3 : 1;
  const bool is_list = p.type == ParameterType::spectrum && p.strings.empty();
  if (!is_list && count != expected)
    fail(p.where, fmt::format("\"{} {}\" takes {} value{}, got {}", name_of(p.type), p.name,
                              expected, expected == 1 ? "" : "s", count));
}

Rgb value_of(const Parameter& p, SpectrumUse use, const FileFinder& files) {
  check_count(p);
  switch (p.type) {
    case ParameterType::rgb:
      return from_rgb(p, use);
    case ParameterType::blackbody:
      return from_blackbody(p, use);
    case ParameterType::number:
      return from_number(p);
    default:
      return p.strings.empty() ? from_pairs(p, p.numbers, use) : from_name(p, use, files);
  }
}

}  // namespace

std::optional<Rgb> spectrum_parameter(ParameterSet& parameters, std::string_view name,
                                      SpectrumUse use, const FileFinder& files) {
  const Parameter* p =
      parameters.find(name, {ParameterType::rgb, ParameterType::spectrum,
                             ParameterType::blackbody, ParameterType::number});
  if (!p) return std::nullopt;
  try {
    Rgb value = value_of(*p, use, files);
    if (use == SpectrumUse::reflectance)
      for (int i = 0; i < 3; ++i) value[i] = std::min(value[i], 1.0f);
    return value;
  } catch (const Failure& failure) {
    parameters.reporter().error(failure.where,
                                fmt::format("{}: {}", parameters.owner(), failure.message));
    return std::nullopt;
  }
}

}  // namespace tyndall::loader
