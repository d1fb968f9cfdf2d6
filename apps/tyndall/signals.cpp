// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/signals.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace tyndall::app {

namespace {

std::atomic<bool> stop_requested{false}, quiet{false};
static_assert(std::atomic<bool>::is_always_lock_free, "used in a signal handler");

// Only calls that are safe in a signal handler.
extern "C" void handle_stop_signal(int signal) {
  if (stop_requested.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  if (quiet) return;
  constexpr std::string_view message =
      "\nstopping; a second signal ends at once and writes nothing\n";
  [[maybe_unused]] const ssize_t written =
      write(STDERR_FILENO, message.data(), message.size());
}

void install(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

StopOnSignal::StopOnSignal(bool is_quiet) {
  stop_requested = false;
  quiet = is_quiet;
  install(handle_stop_signal);
}

StopOnSignal::~StopOnSignal() { install(SIG_DFL); }

const std::atomic<bool>& StopOnSignal::flag() const { return stop_requested; }

}  // namespace tyndall::app
