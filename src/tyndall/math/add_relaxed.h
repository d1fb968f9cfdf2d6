// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace tyndall {

/// Adds to a sum that many threads add to and none reads before all have ended.
inline void add_relaxed(std::atomic<int64_t>& sum, int64_t term) {
  sum.fetch_add(term, std::memory_order_relaxed);
}

}  // namespace tyndall
