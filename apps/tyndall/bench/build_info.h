// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "apps/tyndall/report/results.h"

namespace tyndall::app {

/// The commit that was built, with "-dirty" if files were changed; "unknown" outside git.
std::string build_commit();
/// "gcc 12.2.0, Release".
std::string build_compiler();
/// What the build type added to the compiler's command line.
std::string build_flags();

/// This computer, as far as the system tells.
Machine this_machine();

/// Now, UTC: "2026-11-23T06:00:00Z".
std::string utc_now();

}  // namespace tyndall::app
