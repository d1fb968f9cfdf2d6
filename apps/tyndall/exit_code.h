// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace tyndall::app {

/// What the program's exit status means, the same for all subcommands; docs/cli.md repeats
/// it. A second SIGINT or SIGTERM ends the process by that signal: 130 or 143 in a shell.
enum class ExitCode {
  done = 0,
  usage = 1,      ///< wrong arguments
  scene = 2,      ///< a scene or another input file is missing or wrong
  resources = 3,  ///< not enough memory
  stopped = 4,    ///< by time limit or signal; the outputs are valid and hold what was done
  output = 5,     ///< an output cannot be written
  check_failed = 6,  ///< a check that the arguments asked for does not hold
};

/// Arguments that do not make sense. what() is a sentence without "error:".
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// More memory wanted than there is.
class ResourceError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An output that cannot be written.
class OutputError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs a subcommand. Turns exceptions into one message on stderr and an exit code:
/// UsageError and std::invalid_argument 1, SceneError and any other error 2, ResourceError
/// and std::bad_alloc 3, OutputError 5.
ExitCode run_guarded(const std::function<ExitCode()>& run);

/// The table of exit codes for --help.
std::string exit_code_help();

}  // namespace tyndall::app
