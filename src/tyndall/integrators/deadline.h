// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

namespace tyndall {

/// When work must end; by default never. Asking takes some 30 ns.
class Deadline {
 public:
  Deadline() = default;
  /// So many seconds from now.
  static Deadline in(double seconds) { return Deadline(now() + seconds); }

  bool is_set() const { return end_ < std::numeric_limits<double>::infinity(); }
  bool has_passed() const { return is_set() && now() >= end_; }
  /// Negative once it has passed, infinite if there is none [s].
  double seconds_left() const { return end_ - now(); }
  /// Later, if there are not so many seconds left.
  Deadline at_least(double seconds) const {
    return Deadline(std::max(end_, now() + seconds));
  }

 private:
  explicit Deadline(double end) : end_(end) {}
  static double now() {
    return std::chrono::duration<double>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }

  double end_ = std::numeric_limits<double>::infinity();  // of the steady clock [s]
};

}  // namespace tyndall
