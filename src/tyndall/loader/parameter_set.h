// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tyndall/loader/parameter.h"
#include "tyndall/loader/reporter.h"
#include "tyndall/math/constants.h"
#include "tyndall/math/vec.h"

namespace tyndall::loader {

/// The numbers that a parameter may be.
struct Range {
  float min = -infinity, max = infinity;
  bool is_open = false;  ///< neither end belongs to it

  bool contains(float x) const {
    return is_open ? min < x && x < max : min <= x && x <= max;
  }
  std::string text() const;  ///< "must be positive", "must lie in [0, 1]"
};
inline constexpr Range any_number{};
inline constexpr Range not_negative{0, infinity};
inline constexpr Range positive{0, infinity, true};

/// The parameters of one directive. Questions mark a parameter as used; what nobody has
/// asked for in the end is an error. Wrong types, counts and ranges are reported at the
/// parameter, and the default is returned.
class ParameterSet {
 public:
  /// `owner` names the directive in messages: `Camera "perspective"`. `defaults` come from
  /// Attribute directives and may be null.
  ParameterSet(std::string owner, Span where, Reporter& reporter,
               std::vector<Parameter> own,
               const std::vector<Parameter>* defaults = nullptr);

  float number(std::string_view name, float otherwise, Range range = any_number);
  int integer(std::string_view name, int otherwise, Range range = any_number);
  bool boolean(std::string_view name, bool otherwise);
  std::string string(std::string_view name, std::string otherwise);
  /// A string that must be given. Throws Failure if it is not.
  std::string required_string(std::string_view name);
  std::optional<Vec3> point3(std::string_view name);

  std::vector<float> numbers(std::string_view name);
  std::vector<int> integers(std::string_view name);
  std::vector<std::string> strings(std::string_view name);
  std::vector<Vec2> points2(std::string_view name);
  std::vector<Vec3> points3(std::string_view name);
  std::vector<Vec3> normals(std::string_view name);

  /// The parameter if it is given with one of the types, null otherwise.
  Parameter* find(std::string_view name, std::initializer_list<ParameterType> types);
  bool has(std::string_view name) const;
  bool has_texture(std::string_view name) const;
  /// Valid in pbrt-v4 but without influence here.
  void ignore(std::initializer_list<std::string_view> names);
  void ignore_all();
  /// Reports parameters that nobody asked for. Call once, at the end.
  void report_unknown();

  /// Throws Failure: the directive or its parameter "type" asks for a `what` that is none
  /// of `names`.
  [[noreturn]] void fail_unknown_type(std::string_view what, std::string_view type,
                                      const std::vector<std::string_view>& names) const;

  const std::string& owner() const { return owner_; }
  Span where() const { return where_; }
  Reporter& reporter() const { return *reporter_; }
  /// Where to point for a parameter: at it, or at the directive if it is not given.
  Span where(std::string_view name) const;

  /// About the parameter, with the owner's name before the message.
  void error(std::string_view name, std::string_view message) const;
  void unsupported(std::string_view name, std::string_view message) const;
  void warning(std::string_view name, std::string_view message) const;

 private:
  const Parameter* look_up(std::string_view name) const;
  bool has_one_value(const Parameter& parameter, size_t count) const;

  std::string owner_;
  Span where_;
  Reporter* reporter_;
  std::vector<Parameter> parameters_;  // own ones first
  std::vector<std::string_view> asked_;
};

}  // namespace tyndall::loader
