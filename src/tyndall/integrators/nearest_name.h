// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

/// The most similar of `names`; empty if none is similar enough to be meant.
std::string_view nearest_name(std::string_view name,
                              const std::vector<std::string_view>& names);

/// `; did you mean "..."?` with the most similar of `names`, or an empty string if none is
/// similar enough to be meant.
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& names);

/// The keys of a map from names.
template <typename Map>
std::vector<std::string_view> keys_of(const Map& map) {
  std::vector<std::string_view> keys;
  keys.reserve(map.size());
  for (const auto& entry : map) keys.push_back(entry.first);
  return keys;
}

/// The names in quotes, with commas between.
std::string quoted_list(const std::vector<std::string_view>& names);

}  // namespace tyndall
