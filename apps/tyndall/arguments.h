// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/tyndall/exit_code.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace tyndall::app {

/// Called with the text of an argument; throws std::invalid_argument with a sentence that
/// says what the text should be.
using ArgumentParser = std::function<void(const std::string&)>;

/// Where the value of an option goes. A vector collects every occurrence of the option.
using ArgumentTarget =
    std::variant<int*, uint32_t*, uint64_t*, float*, double*, std::string*,
                 std::optional<int>*, std::optional<uint32_t>*, std::optional<uint64_t>*,
                 std::optional<float>*, std::optional<double>*, std::optional<std::string>*,
                 std::vector<std::string>*, ArgumentParser>;

/// What an option needs beyond its name, target and help.
struct ArgumentStyle {
  std::string value = "TEXT";             ///< how help shows the value: "N", "FILE"
  std::vector<std::string> choices = {};  ///< the only valid values, if there are any
  std::string group = "Options";          ///< heading in help
  bool required = false;
  bool repeatable = false;  ///< every occurrence counts, not only the last; vectors always
};

/// One subcommand's arguments. A thin face of CLI11, which only arguments.cpp includes
/// because it is slow to compile.
///
/// Every option `--some-name` has an environment twin TYNDALL_SOME_NAME, which the command
/// line overrides. Names are CLI11's: "-o,--output".
class Command {
 public:
  Command(CLI::App* app, std::function<ExitCode()>* selected)
      : app_(app), selected_(selected) {}

  /// An argument without a flag: one value, or any number if the target is a vector.
  Command& positional(const std::string& name, const ArgumentTarget& target,
                      const std::string& help, const ArgumentStyle& style = {});
  Command& option(const std::string& names, const ArgumentTarget& target,
                  const std::string& help, const ArgumentStyle& style = {});
  Command& flag(const std::string& names, bool* target, const std::string& help,
                const std::string& group = "Options");
  /// Text below the options in help.
  Command& footer(const std::string& text);
  /// What the subcommand does once its arguments are read. May throw; see run_guarded().
  Command& on_run(std::function<ExitCode()> run);

 private:
  CLI::App* app_;
  std::function<ExitCode()>*
      selected_;  // what the program runs once all arguments are read
};

/// The program: its subcommands, --help and --version.
class Program {
 public:
  Program(const std::string& name, const std::string& description,
          const std::string& version);
  ~Program();

  Command add_command(const std::string& name, const std::string& description);
  /// Reads the arguments and runs the subcommand. Messages go to stderr, help to stdout.
  ExitCode run(int argc, const char* const* argv);
  /// The whole command line of run(), quoted for a POSIX shell.
  const std::string& command_line() const { return command_line_; }

 private:
  ExitCode explain(const CLI::ParseError& error) const;

  std::unique_ptr<CLI::App> app_;
  std::function<ExitCode()> selected_;
  std::string command_line_;
};

}  // namespace tyndall::app
