// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tyndall::app {

/// "tyndall 0.1.0": the software attribute of images.
std::string version_name();

/// version_name() and what it was built with, several lines, as --version prints it.
std::string version_text();

}  // namespace tyndall::app
