// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace tyndall::app {

/// Begins to look for a new peak of this process's memory, where the system can (Linux).
void reset_peak_memory();

/// The most memory [bytes] that the process had in use since reset_peak_memory(); empty
/// where the system does not tell.
std::optional<double> peak_memory_since_reset();

}  // namespace tyndall::app
