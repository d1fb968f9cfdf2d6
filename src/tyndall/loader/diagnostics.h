// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tyndall {

/// A place in a scene file, with the chain of files that included it.
struct SourceLocation {
  std::string file;
  int line = 0, column = 0;
};

enum class Severity { warning, error };

/// One message about a scene, ready to print: place, severity, text, source line, caret,
/// "included from" notes.
struct Diagnostic {
  Severity severity;
  SourceLocation where;
  std::string message;  ///< the sentence alone
  std::string text;     ///< everything, several lines, no trailing newline
};

/// Called with each warning as it is found; errors come as one SceneError.
using WarningSink = std::function<void(const Diagnostic&)>;

/// A scene that cannot be loaded. what() is the text of all diagnostics, up to 20.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Diagnostic> diagnostics);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace tyndall
