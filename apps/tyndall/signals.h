// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace tyndall::app {

/// While one of these lives, the first SIGINT or SIGTERM only sets the flag, so that work
/// can end in an orderly way; the second ends the process by that signal. The first prints
/// a line that says so, unless it is to be quiet. One at a time.
class StopOnSignal {
 public:
  explicit StopOnSignal(bool is_quiet);
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  const std::atomic<bool>& flag() const;
};

}  // namespace tyndall::app
