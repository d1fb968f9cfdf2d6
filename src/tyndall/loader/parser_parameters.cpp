// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/numbers.h"
#include "tyndall/loader/parser.h"
#include "tyndall/loader/scene_builder.h"

namespace tyndall::loader {
namespace {

struct TypeName {
  std::string_view name;
  ParameterType type;
};

constexpr std::array type_names{
    TypeName{"bool", ParameterType::boolean},
    TypeName{"integer", ParameterType::integer},
    TypeName{"float", ParameterType::number},
    TypeName{"point2", ParameterType::point2},
    TypeName{"vector2", ParameterType::vector2},
    TypeName{"point3", ParameterType::point3},
    TypeName{"vector3", ParameterType::vector3},
    TypeName{"normal", ParameterType::normal},
    TypeName{"rgb", ParameterType::rgb},
    TypeName{"spectrum", ParameterType::spectrum},
    TypeName{"blackbody", ParameterType::blackbody},
    TypeName{"string", ParameterType::string},
    TypeName{"texture", ParameterType::texture},
    // Synonyms, from pbrt-v3 and from pbrt-v4's own manual.
    TypeName{"point", ParameterType::point3},
    TypeName{"vector", ParameterType::vector3},
    TypeName{"normal3", ParameterType::normal},
    TypeName{"color", ParameterType::rgb},
};

ParameterType type_by_name(std::string_view name, Span where) {
  std::vector<std::string_view> names;
  for (const TypeName& entry : type_names) {
    if (entry.name == name) return entry.type;
    names.push_back(entry.name);
  }
  fail(where,
       fmt::format("unknown parameter type \"{}\"{}", name, did_you_mean(name, names)));
}

// Values come in groups of so many numbers.
size_t group_size(ParameterType type) {
  switch (type) {
    case ParameterType::point2:
    case ParameterType::vector2:
      return 2;
    case ParameterType::point3:
    case ParameterType::vector3:
    case ParameterType::normal:
    case ParameterType::rgb:
      return 3;
    default:
      return 1;
  }
}

struct Declaration {
  std::string_view type, name;
};

Declaration split(const Token& token) {
  constexpr std::string_view blanks = " \t";
  const std::string_view text = token.text;
  const size_t type_begin = std::min(text.find_first_not_of(blanks), text.size());
  const size_t type_end = std::min(text.find_first_of(blanks, type_begin), text.size());
  const size_t name_begin = std::min(text.find_first_not_of(blanks, type_end), text.size());
  const size_t name_end = std::min(text.find_first_of(blanks, name_begin), text.size());
  if (name_begin == name_end || text.find_first_not_of(blanks, name_end) != text.npos)
    fail(token.where,
         fmt::format("expected a parameter's type and name in quotes, got \"{}\"",
                     text.substr(0, 40)));
  return {text.substr(type_begin, type_end - type_begin),
          text.substr(name_begin, name_end - name_begin)};
}

}  // namespace

std::vector<Parameter> Parser::parameters() {
  std::vector<Parameter> parameters;
  while (tokenizer().peek().kind == TokenKind::string)
    parameters.push_back(parameter(tokenizer().next()));
  return parameters;
}

Parameter Parser::parameter(const Token& declaration) {
  const Declaration names = split(declaration);
  Parameter parameter{.type = type_by_name(names.type, declaration.where),
                      .name = std::string(names.name),
                      .where = declaration.where,
                      .color_space = builder_.color_space(),
                      .numbers = {},
                      .integers = {},
                      .strings = {},
                      .booleans = {}};
  read_values(parameter);
  const size_t group = group_size(parameter.type);
  if (parameter.numbers.size() % group != 0)
    fail(parameter.where,
         fmt::format("\"{} {}\" takes numbers in groups of {}, got {}", names.type,
                     names.name, group, parameter.numbers.size()));
  return parameter;
}

void Parser::read_values(Parameter& parameter) {
  Token token = tokenizer().next();
  if (token.kind != TokenKind::open_bracket) {
    add_value(parameter, token);
    parameter.where = join(parameter.where, token.where);
    return;
  }
  for (token = tokenizer().next(); token.kind != TokenKind::close_bracket;
       token = tokenizer().next())
    add_value(parameter, token);
  parameter.where = join(parameter.where, token.where);
}

template <typename T>
void Parser::add_number(std::vector<T>& numbers, const Parameter& parameter,
                        const Token& token) {
  T value{};
  const NumberError error = token.kind == TokenKind::word ? parse_number(token.text, value)
                                                          : NumberError::malformed;
  numbers.push_back(value);
  if (error == NumberError::none) return;
  if (error == NumberError::too_large)
    fail(token.where, fmt::format("the number {} is too large", token.text.substr(0, 40)));
  fail_at(token, fmt::format("{} for \"{} {}\"",
                             std::is_same_v<T, int> ? "an integer" : "a number",
                             name_of(parameter.type), parameter.name));
}

void Parser::add_value(Parameter& parameter, const Token& token) {
  switch (parameter.type) {
    case ParameterType::integer:
      return add_number(parameter.integers, parameter, token);
    case ParameterType::string:
    case ParameterType::texture:
      if (token.kind != TokenKind::string)
        fail_at(token, fmt::format("a string for \"{} {}\"", name_of(parameter.type),
                                   parameter.name));
      parameter.strings.push_back(unescape(token));
      return;
    case ParameterType::boolean:
      if (token.text != "true" && token.text != "false")
        fail_at(token, fmt::format("true or false for \"bool {}\"", parameter.name));
      parameter.booleans.push_back(token.text == "true");
      return;
    case ParameterType::spectrum:
      if (token.kind == TokenKind::string && parameter.numbers.empty()) {
        parameter.strings.push_back(unescape(token));
        return;
      }
      [[fallthrough]];
    default:
      return add_number(parameter.numbers, parameter, token);
  }
}

}  // namespace tyndall::loader
