// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tyndall::loader {

/// `; did you mean "..."?` with the most similar of `names`, or an empty string if none is
/// similar enough to be meant.
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& names);

/// The names in quotes, with commas between.
std::string quoted_list(const std::vector<std::string_view>& names);

}  // namespace tyndall::loader
