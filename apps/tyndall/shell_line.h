// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tyndall::app {

/// Arguments as one line that a POSIX shell would split into them again.
std::string shell_line(int argc, const char* const* argv);

}  // namespace tyndall::app
