// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "tyndall/loader/files.h"
#include "tyndall/loader/parameter_set.h"
#include "tyndall/loader/spectrum.h"
#include "tyndall/math/rgb.h"

namespace tyndall::loader {

/// Named textures, each as its mean value: tyndall has no textures yet.
class TextureTable {
 public:
  explicit TextureTable(const FileFinder& files) : files_(files) {}

  /// A Texture directive. What varies is reported as not supported.
  void make(const std::string& name, const std::string& kind, const std::string& type,
            ParameterSet& parameters);

  /// A spectrum parameter that may be a texture. Empty if it is not given.
  std::optional<Rgb> spectrum(ParameterSet& parameters, std::string_view name,
                              SpectrumUse use) const;
  /// A float parameter that may be a texture.
  float number(ParameterSet& parameters, std::string_view name, float otherwise,
               Range range = any_number) const;

 private:
  std::optional<Rgb> value(ParameterSet& parameters, std::string_view name,
                           bool is_float) const;
  std::optional<Rgb> operand(ParameterSet& parameters, std::string_view name,
                             bool is_float) const;
  Rgb mean(const std::string& type, ParameterSet& parameters, bool is_float);
  Rgb mean_of_picture(ParameterSet& parameters) const;

  const FileFinder& files_;
  std::map<std::string, Rgb, std::less<>> numbers_, spectra_;
};

}  // namespace tyndall::loader
