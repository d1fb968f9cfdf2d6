// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/crash_report.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "apps/tyndall/exit_code.h"
#include "tyndall/media/volume_in_hand.h"

namespace tyndall::app {

namespace {

void write_text(std::string_view text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

// Only calls that are safe in a signal handler. To return is to crash as without it: the
// signal comes again, and its action is the default one.
extern "C" void handle_crash(int /*signal*/) {
  const char* const name = volume_in_hand();
  if (!name) return;
  write_text("error: ");
  write_text(name);
  write_text(": reading it crashed: it is damaged\n");
  _exit(static_cast<int>(ExitCode::scene));
}

}  // namespace

void report_crashes_in_volumes() {
  struct sigaction action = {};
  action.sa_handler = handle_crash;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT})
    sigaction(signal, &action, nullptr);
}

}  // namespace tyndall::app
