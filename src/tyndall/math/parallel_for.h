// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace tyndall {

/// Calls body(i) for each i below `count`, each once, in any order and at the same time on
/// as many threads as the caller's oneTBB arena has. What body throws, this throws.
void parallel_for(size_t count, const std::function<void(size_t)>& body);

}  // namespace tyndall
