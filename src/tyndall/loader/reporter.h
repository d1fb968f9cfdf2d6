// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tyndall/loader/diagnostics.h"
#include "tyndall/loader/load_scene.h"
#include "tyndall/loader/source_library.h"

namespace tyndall::loader {

/// What is wrong with one directive; the parser reports it and goes on with the next
/// directive.
struct Failure {
  Span where;
  std::string message;
};

[[noreturn]] inline void fail(Span where, std::string message) {
  throw Failure{where, std::move(message)};
}

/// Collects errors and passes warnings on.
class Reporter {
 public:
  static constexpr size_t max_errors = 20;
  static constexpr int max_alike = 10;  ///< warnings with the same words that are passed on

  Reporter(const SourceLibrary& sources, const LoadOptions& options)
      : sources_(sources), options_(options) {}

  /// Throws SceneError when it is the last of `max_errors`.
  void error(Span where, std::string message);
  void warning(Span where, std::string message);
  /// Valid pbrt-v4 that tyndall cannot do: a warning, or an error in strict mode.
  void unsupported(Span where, std::string message);

  bool has_errors() const { return !errors_.empty(); }
  /// Throws SceneError if there was any error, the errors in the order of the text.
  void throw_if_errors() const;
  std::vector<Diagnostic> take_warnings() { return std::move(warnings_); }
  const SourceLibrary& sources() const { return sources_; }

 private:
  std::string inclusion_notes(uint32_t source) const;
  Diagnostic diagnostic(Severity severity, Span where, std::string message) const;

  const SourceLibrary& sources_;
  const LoadOptions& options_;
  std::vector<std::pair<Span, Diagnostic>> errors_;
  std::vector<Diagnostic> warnings_;
  std::map<std::string, int> warned_;  // how often, by message
};

}  // namespace tyndall::loader
