// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/loader/files.h"
#include "tyndall/loader/parameter_set.h"
#include "tyndall/loader/reporter.h"
#include "tyndall/loader/source_library.h"
#include "tyndall/loader/tokenizer.h"

namespace tyndall::loader {

class SceneBuilder;

/// Reads the directives of a scene file and of the files that it includes, and calls the
/// scene builder for each. After an error it goes on with the next directive.
class Parser {
 public:
  static constexpr int max_depth = 64;                  ///< of inclusion
  static constexpr size_t max_files = size_t{1} << 18;  ///< inclusions in all

  Parser(SourceLibrary& sources, const FileFinder& files, Reporter& reporter,
         SceneBuilder& builder)
      : sources_(sources), files_(files), reporter_(reporter), builder_(builder) {}

  /// Reads the source and all that it includes. Throws SceneError if there are too many
  /// errors.
  void run(uint32_t source);

  // What directives are made of. All throw Failure if the text is not as expected.

  /// The directive being read; its place grows by the names and types that follow it.
  const Token& directive() const { return directive_; }
  double number();
  /// N numbers, with or without brackets around them.
  template <size_t N>
  std::array<double, N> numbers() {
    std::array<double, N> values{};
    read_numbers(values.data(), N);
    return values;
  }
  /// `what` names the string in messages: "a material name".
  std::string string(std::string_view what);
  std::optional<std::string> optional_string();
  /// One token of any kind, without quotes.
  std::string value();
  std::vector<Parameter> parameters();
  /// The following directives come from that file, then from after this directive.
  void include(const std::string& name, Span where, bool is_import);

 private:
  struct Input {
    Tokenizer tokenizer;
    bool is_import;
  };

  Tokenizer& tokenizer() { return inputs_.back().tokenizer; }
  void step();
  void end_input();
  void recover();
  void read_numbers(double* values, size_t count);
  [[noreturn]] void fail_at(const Token& token, std::string_view expected);

  Parameter parameter(const Token& declaration);
  void read_values(Parameter& parameter);
  void add_value(Parameter& parameter, const Token& token);
  template <typename T>
  void add_number(std::vector<T>& numbers, const Parameter& parameter, const Token& token);
  std::shared_ptr<const std::string> text_of(const std::string& path, Span where);

  SourceLibrary& sources_;
  const FileFinder& files_;
  Reporter& reporter_;
  SceneBuilder& builder_;
  std::vector<Input> inputs_;  // the last is being read
  Token directive_{};
  std::map<std::string, std::shared_ptr<const std::string>> texts_;  // by path
};

}  // namespace tyndall::loader
