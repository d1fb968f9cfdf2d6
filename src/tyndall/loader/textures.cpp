// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "tyndall/image/io.h"
#include "tyndall/integrators/nearest_name.h"

namespace tyndall::loader {
namespace {

constexpr Rgb unknown_mean{0.5f, 0.5f, 0.5f};

Rgb mean_color(const Image& image) {
  double sum[3] = {0, 0, 0};
  const bool has_color = image.has_rgb();
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(image.width()) +
                       static_cast<size_t>(x);
      const Rgb c = has_color ? image.rgb(x, y) : Rgb(image.channels().front().values[i]);
      if (!is_finite(c)) continue;
      for (int channel = 0; channel < 3; ++channel) sum[channel] += double{c[channel]};
    }
  const double count = std::max(static_cast<double>(image.pixel_count()), 1.0);
  return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
          static_cast<float>(sum[2] / count)};
}

const std::vector<std::string_view> texture_types{
    "constant", "scale", "mix",    "directionmix", "imagemap", "bilerp",  "checkerboard",
    "dots",     "fbm",   "marble", "ptex",         "windy",    "wrinkled"};

}  // namespace

void TextureTable::make(const std::string& name, const std::string& kind,
                        const std::string& type, ParameterSet& parameters) {
  if (kind != "float" && kind != "spectrum")
    fail(parameters.where(),
         fmt::format("{}: a texture is \"float\" or \"spectrum\", got \"{}\"",
                     parameters.owner(), kind));
  const bool is_float = kind == "float";
  auto& table = is_float ? numbers_ : spectra_;
  const auto [entry, is_new] = table.emplace(name, unknown_mean);
  if (!is_new)
    fail(parameters.where(),
         fmt::format("there is already a {} texture named \"{}\"", kind, name));
  entry->second = mean(type, parameters, is_float);
}

// A plain value or another texture.
std::optional<Rgb> TextureTable::operand(ParameterSet& parameters, std::string_view name,
                                         bool is_float) const {
  if (auto textured = value(parameters, name, is_float)) return textured;
  if (is_float) {
    const bool is_given = parameters.has(name);
    const Rgb number(parameters.number(name, 0));
    return is_given ? std::optional(number) : std::nullopt;
  }
  return spectrum_parameter(parameters, name, SpectrumUse::coefficient, files_);
}

Rgb TextureTable::mean(const std::string& type, ParameterSet& parameters, bool is_float) {
  const auto get = [&](std::string_view name, float otherwise) {
    return operand(parameters, name, is_float).value_or(Rgb(otherwise));
  };
  if (type == "constant") return get("value", 1);
  if (type == "scale") return get("tex", 1) * number(parameters, "scale", 1);
  if (type == "mix" || type == "directionmix") {
    parameters.ignore({"dir"});
    const float amount = type == "mix" ? number(parameters, "amount", 0.5f) : 0.5f;
    return get("tex1", 0) * (1 - amount) + get("tex2", 1) * amount;
  }
  const auto& known = texture_types;
  if (std::find(known.begin(), known.end(), type) == known.end())
    parameters.fail_unknown_type("texture", type, known);
  parameters.reporter().unsupported(
      parameters.where(),
      fmt::format("{}: textures of type \"{}\" are not supported yet, the mean is used",
                  parameters.owner(), type));
  Rgb result = unknown_mean;
  if (type == "imagemap") result = mean_of_picture(parameters);
  if (type == "checkerboard") result = (get("tex1", 1) + get("tex2", 0)) * 0.5f;
  if (type == "bilerp")
    result = (get("v00", 0) + get("v01", 1) + get("v10", 0) + get("v11", 1)) * 0.25f;
  if (type == "dots") result = (get("inside", 1) + get("outside", 0)) * 0.5f;
  parameters.ignore_all();
  return result;
}

Rgb TextureTable::mean_of_picture(ParameterSet& parameters) const {
  const std::string name = parameters.required_string("filename");
  const Span where = parameters.where("filename");
  const std::string path = files_.find(name, where);
  Rgb result = unknown_mean;
  try {
    result = mean_color(read_image(path));
  } catch (const std::runtime_error& error) {
    parameters.reporter().unsupported(
        where, fmt::format("{}; a grey of 0.5 takes its place", error.what()));
    return result;
  }
  if (parameters.boolean("invert", false)) result = Rgb(1) - result;
  return clamp_negative(result) * parameters.number("scale", 1, not_negative);
}

// Empty if the parameter is not a texture.
std::optional<Rgb> TextureTable::value(ParameterSet& parameters, std::string_view name,
                                       bool is_float) const {
  if (!parameters.has_texture(name)) return std::nullopt;
  const Parameter* parameter = parameters.find(name, {ParameterType::texture});
  if (parameter->strings.size() != 1) {
    parameters.error(name, fmt::format("parameter \"{}\" takes one texture, got {}", name,
                                       parameter->strings.size()));
    return unknown_mean;
  }
  const auto& table = is_float ? numbers_ : spectra_;
  const auto found = table.find(parameter->strings[0]);
  if (found != table.end()) return found->second;
  parameters.error(name, fmt::format("there is no {} texture named \"{}\"{}",
                                     is_float ? "float" : "spectrum", parameter->strings[0],
                                     did_you_mean(parameter->strings[0], keys_of(table))));
  return unknown_mean;
}

std::optional<Rgb> TextureTable::spectrum(ParameterSet& parameters, std::string_view name,
                                          SpectrumUse use) const {
  if (std::optional<Rgb> color = value(parameters, name, false)) {
    if (use == SpectrumUse::reflectance)
      for (int i = 0; i < 3; ++i) (*color)[i] = std::clamp((*color)[i], 0.0f, 1.0f);
    return color;
  }
  return spectrum_parameter(parameters, name, use, files_);
}

float TextureTable::number(ParameterSet& parameters, std::string_view name, float otherwise,
                           Range range) const {
  const std::optional<Rgb> textured = value(parameters, name, true);
  if (!textured) return parameters.number(name, otherwise, range);
  return std::clamp(textured->r, range.min, range.max);
}

}  // namespace tyndall::loader
