// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>

namespace tyndall {

/// When work must end: at a time, or once somebody says so; by default never. Asking takes
/// some 30 ns.
class Deadline {
 public:
  Deadline() = default;
  /// So many seconds from now, or when `stop` becomes true.
  static Deadline in(double seconds, const std::atomic<bool>* stop = nullptr) {
    return {now() + seconds, stop};
  }

  /// Whether it can pass.
  bool is_set() const { return stop_ || has_end(); }
  bool has_passed() const {
    if (has_end() && now() >= end_) return true;
    return stop_ && stop_->load(std::memory_order_relaxed) && now() >= first_stop_;
  }
  /// Negative once it has passed, infinite if there is none [s].
  double seconds_left() const { return end_ - now(); }
  /// Later, if there are not so many seconds left or somebody has said to stop.
  Deadline at_least(double seconds) const {
    Deadline later(std::max(end_, now() + seconds), stop_);
    later.first_stop_ = now() + seconds;
    return later;
  }
  /// In a share of the seconds left; no later if it is to stop.
  Deadline in_share(double share) const {
    Deadline earlier = *this;
    if (has_end()) earlier.end_ = now() + share * seconds_left();
    return earlier;
  }

 private:
  Deadline(double end, const std::atomic<bool>* stop) : end_(end), stop_(stop) {}
  bool has_end() const { return end_ < std::numeric_limits<double>::infinity(); }
  static double now() {
    return std::chrono::duration<double>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }

  double end_ = std::numeric_limits<double>::infinity();  // of the steady clock [s]
  double first_stop_ = 0;                                 // the same
  const std::atomic<bool>* stop_ = nullptr;
};

}  // namespace tyndall
