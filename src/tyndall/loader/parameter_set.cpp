// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/parameter_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "tyndall/integrators/nearest_name.h"

namespace tyndall::loader {
namespace {

std::string alternatives(std::initializer_list<ParameterType> types) {
  std::string text;
  for (const ParameterType type : types)
    text += fmt::format("{}\"{}\"", text.empty() ? "" : " or ", name_of(type));
  return text;
}

std::vector<Vec3> triples(const Parameter* parameter) {
  std::vector<Vec3> result;
  if (!parameter) return result;
  const std::vector<float>& x = parameter->numbers;
  result.reserve(x.size() / 3);
  for (size_t i = 0; i + 2 < x.size(); i += 3) result.push_back({x[i], x[i + 1], x[i + 2]});
  return result;
}

}  // namespace

std::string_view name_of(ParameterType type) {
  switch (type) {
    case ParameterType::boolean:
      return "bool";
    case ParameterType::integer:
      return "integer";
    case ParameterType::number:
      return "float";
    case ParameterType::point2:
      return "point2";
    case ParameterType::vector2:
      return "vector2";
    case ParameterType::point3:
      return "point3";
    case ParameterType::vector3:
      return "vector3";
    case ParameterType::normal:
      return "normal";
    case ParameterType::rgb:
      return "rgb";
    case ParameterType::spectrum:
      return "spectrum";
    case ParameterType::blackbody:
      return "blackbody";
    case ParameterType::string:
      return "string";
    case ParameterType::texture:
      return "texture";
  }
  return "";
}

std::string Range::text() const {
  if (min == 0 && max == infinity)
    return is_open ? "must be positive" : "must not be negative";
  if (max == infinity)
    return fmt::format("must be {} {}", is_open ? "above" : "at least", min);
  return fmt::format("must lie in {}{}, {}{}", is_open ? "(" : "[", min, max,
                     is_open ? ")" : "]");
}

ParameterSet::ParameterSet(std::string owner, Span where, Reporter& reporter,
                           std::vector<Parameter> own,
                           const std::vector<Parameter>* defaults)
    : owner_(std::move(owner)),
      where_(where),
      reporter_(&reporter),
      parameters_(std::move(own)) {
  if (defaults) parameters_.insert(parameters_.end(), defaults->begin(), defaults->end());
}

const Parameter* ParameterSet::look_up(std::string_view name) const {
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const Parameter& p) { return p.name == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

bool ParameterSet::has(std::string_view name) const { return look_up(name) != nullptr; }

bool ParameterSet::has_texture(std::string_view name) const {
  const Parameter* parameter = look_up(name);
  return parameter && parameter->type == ParameterType::texture;
}

Span ParameterSet::where(std::string_view name) const {
  const Parameter* parameter = look_up(name);
  return parameter ? parameter->where : where_;
}

Parameter* ParameterSet::find(std::string_view name,
                              std::initializer_list<ParameterType> types) {
  ignore({name});  // further ones of the same name are shadowed, as in pbrt-v4
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const Parameter& p) { return p.name == name; });
  if (found == parameters_.end()) return nullptr;
  if (std::find(types.begin(), types.end(), found->type) != types.end()) return &*found;
  error(name, fmt::format("parameter \"{}\" must be of type {}, not \"{}\"", name,
                          alternatives(types), name_of(found->type)));
  return nullptr;
}

bool ParameterSet::has_one_value(const Parameter& parameter, size_t count) const {
  if (count == 1) return true;
  error(parameter.name,
        fmt::format("parameter \"{}\" takes one value, got {}", parameter.name, count));
  return false;
}

float ParameterSet::number(std::string_view name, float otherwise, Range range) {
  const Parameter* parameter = find(name, {ParameterType::number});
  if (!parameter || !has_one_value(*parameter, parameter->numbers.size())) return otherwise;
  const float value = parameter->numbers[0];
  if (range.contains(value)) return value;
  error(name, fmt::format("parameter \"{}\" {}, got {}", name, range.text(), value));
  return otherwise;
}

int ParameterSet::integer(std::string_view name, int otherwise, Range range) {
  const Parameter* parameter = find(name, {ParameterType::integer});
  if (!parameter || !has_one_value(*parameter, parameter->integers.size()))
    return otherwise;
  const int value = parameter->integers[0];
  if (range.contains(static_cast<float>(value))) return value;
  error(name, fmt::format("parameter \"{}\" {}, got {}", name, range.text(), value));
  return otherwise;
}

bool ParameterSet::boolean(std::string_view name, bool otherwise) {
  const Parameter* parameter = find(name, {ParameterType::boolean});
  if (!parameter || !has_one_value(*parameter, parameter->booleans.size()))
    return otherwise;
  return parameter->booleans[0] != 0;
}

std::string ParameterSet::string(std::string_view name, std::string otherwise) {
  const Parameter* parameter = find(name, {ParameterType::string});
  if (!parameter || !has_one_value(*parameter, parameter->strings.size())) return otherwise;
  return parameter->strings[0];
}

std::string ParameterSet::required_string(std::string_view name) {
  ignore({name});
  const Parameter* parameter = look_up(name);
  if (parameter && parameter->strings.size() == 1) return parameter->strings[0];
  if (!has(name))
    fail(where_, fmt::format("{}: parameter \"string {}\" is missing", owner_, name));
  fail(where(name), fmt::format("{}: parameter \"{}\" must be one string", owner_, name));
}

std::optional<Vec3> ParameterSet::point3(std::string_view name) {
  const std::vector<Vec3> values = points3(name);
  if (values.empty() || !has_one_value(*look_up(name), values.size())) return std::nullopt;
  return values[0];
}

std::vector<float> ParameterSet::numbers(std::string_view name) {
  Parameter* parameter = find(name, {ParameterType::number});
  return parameter ? std::move(parameter->numbers) : std::vector<float>{};
}

std::vector<int> ParameterSet::integers(std::string_view name) {
  Parameter* parameter = find(name, {ParameterType::integer});
  return parameter ? std::move(parameter->integers) : std::vector<int>{};
}

std::vector<std::string> ParameterSet::strings(std::string_view name) {
  Parameter* parameter = find(name, {ParameterType::string});
  return parameter ? std::move(parameter->strings) : std::vector<std::string>{};
}

std::vector<Vec2> ParameterSet::points2(std::string_view name) {
  const Parameter* parameter = find(name, {ParameterType::point2, ParameterType::vector2});
  std::vector<Vec2> result;
  if (!parameter) return result;
  for (size_t i = 0; i + 1 < parameter->numbers.size(); i += 2)
    result.push_back({parameter->numbers[i], parameter->numbers[i + 1]});
  return result;
}

std::vector<Vec3> ParameterSet::points3(std::string_view name) {
  return triples(find(name, {ParameterType::point3, ParameterType::vector3}));
}

std::vector<Vec3> ParameterSet::normals(std::string_view name) {
  return triples(find(name, {ParameterType::normal}));
}

void ParameterSet::error(std::string_view name, std::string_view message) const {
  reporter_->error(where(name), fmt::format("{}: {}", owner_, message));
}

void ParameterSet::unsupported(std::string_view name, std::string_view message) const {
  reporter_->unsupported(where(name), fmt::format("{}: {}", owner_, message));
}

void ParameterSet::warning(std::string_view name, std::string_view message) const {
  reporter_->warning(where(name), fmt::format("{}: {}", owner_, message));
}

void ParameterSet::fail_unknown_type(std::string_view what, std::string_view type,
                                     const std::vector<std::string_view>& names) const {
  const std::string nearest = did_you_mean(type, names);
  fail(where("type"),
       fmt::format("{}: there is no such {}{}", owner_, what,
                   nearest.empty() ? "; there is " + quoted_list(names) : nearest));
}

void ParameterSet::ignore(std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    asked_.push_back(name);
    for (Parameter& p : parameters_) p.is_used = p.is_used || p.name == name;
  }
}

void ParameterSet::ignore_all() {
  for (Parameter& p : parameters_) p.is_used = true;
}

void ParameterSet::report_unknown() {
  for (const Parameter& p : parameters_) {
    if (p.is_used || p.is_default) continue;
    reporter_->error(p.where, fmt::format("{}: unknown parameter \"{}\"{}", owner_, p.name,
                                          did_you_mean(p.name, asked_)));
  }
}

}  // namespace tyndall::loader
