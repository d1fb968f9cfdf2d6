// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tyndall/scene/scene_description.h"

namespace tyndall {

/// What is wrong with the boundaries between media, named by shape: those that are open, so
/// that light gets in without getting out again, and those that are inside out, so that
/// their medium fills all space but them. Shapes that state the same two media may close
/// each other.
std::vector<std::string> check_boundaries(std::span<const Surface> surfaces);

}  // namespace tyndall
