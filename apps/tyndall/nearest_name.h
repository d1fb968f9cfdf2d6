// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tyndall::app {

/// The one of `names` that `typed` was probably meant to be, by edit distance; empty if
/// none is near.
std::string nearest_name(const std::string& typed, const std::vector<std::string>& names);

}  // namespace tyndall::app
