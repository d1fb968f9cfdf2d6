// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/exit_code.h"

#include <fmt/core.h>

#include <cstdio>
#include <new>

#include "tyndall/loader/diagnostics.h"
#include "tyndall/loader/excerpt.h"

namespace tyndall::app {

namespace {

ExitCode report(ExitCode code, const std::string& message) {
  fmt::print(stderr, "error: {}\n", message);
  return code;
}

}  // namespace

ExitCode run_guarded(const std::function<ExitCode()>& run) {
  try {
    return run();
  } catch (const SceneError& error) {
    // Its text carries place and severity already.
    fmt::print(stderr, "{}\n", error.what());
    return ExitCode::scene;
  } catch (const UsageError& error) {
    return report(ExitCode::usage, error.what());
  } catch (const OutputError& error) {
    return report(ExitCode::output, error.what());
  } catch (const ResourceError& error) {
    return report(ExitCode::resources, error.what());
  } catch (const std::bad_alloc&) {
    return report(ExitCode::resources, "not enough memory");
  } catch (const std::invalid_argument& error) {
    return report(ExitCode::usage, error.what());
  } catch (const std::exception& error) {
    // It may quote a file that is damaged.
    return report(ExitCode::scene, loader::printable(error.what()));
  }
}

std::string exit_code_help() {
  return "Exit status:\n"
         "  0  done\n"
         "  1  wrong arguments\n"
         "  2  a scene or another input is missing or wrong\n"
         "  3  not enough memory\n"
         "  4  stopped by --time or a signal; the outputs are valid and hold what was "
         "done\n"
         "  5  an output cannot be written\n"
         "  6  a check that the arguments asked for does not hold\n"
         "  130, 143  killed by a second SIGINT or SIGTERM\n";
}

}  // namespace tyndall::app
