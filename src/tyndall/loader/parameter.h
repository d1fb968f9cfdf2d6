// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tyndall/loader/color_space.h"
#include "tyndall/loader/source_library.h"

namespace tyndall::loader {

enum class ParameterType {
  boolean,
  integer,
  number,  // "float" in scene files
  point2,
  vector2,
  point3,
  vector3,
  normal,
  rgb,
  spectrum,
  blackbody,
  string,
  texture,
};

/// As scene files write it.
std::string_view name_of(ParameterType type);

/// One `"type name" [ values ]` of a directive. Which of the vectors holds the values, the
/// type says; a spectrum has numbers or strings.
struct Parameter {
  ParameterType type;
  std::string name;
  Span where;                                 ///< declaration and values
  ColorSpace color_space = ColorSpace::srgb;  ///< in force where it stands
  bool is_default = false;                    ///< from an Attribute directive
  bool is_used = false;

  std::vector<float> numbers;
  std::vector<int> integers;
  std::vector<std::string> strings;
  std::vector<char> booleans;
};

}  // namespace tyndall::loader
