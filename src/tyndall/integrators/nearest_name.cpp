// SPDX-License-Identifier: Apache-2.0
#include "tyndall/integrators/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace tyndall {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// Levenshtein distance, upper and lower case alike.
size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0]++;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t substitution = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substitution, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// A name that is cut short, or goes on, is near.
size_t distance_to(std::string_view name, std::string_view candidate) {
  const size_t distance = edit_distance(name, candidate);
  const bool is_part = std::min(name.size(), candidate.size()) >= 3 &&
                       (candidate.starts_with(name) || name.starts_with(candidate));
  return is_part ? std::min<size_t>(distance, 2) : distance;
}

}  // namespace

std::string_view nearest_name(std::string_view name,
                              const std::vector<std::string_view>& names) {
  constexpr size_t longest = 64;  // of a name that can be a misspelling
  if (name.size() > longest) return {};
  std::string_view best;
  size_t best_distance = (name.size() <= 3 ? 1 : std::max<size_t>(name.size() / 3, 2)) + 1;
  for (const std::string_view candidate : names) {
    const size_t distance = distance_to(name, candidate);
    if (distance >= best_distance || distance >= candidate.size()) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

std::string did_you_mean(std::string_view name,
                         const std::vector<std::string_view>& names) {
  const std::string_view nearest = nearest_name(name, names);
  return nearest.empty() ? std::string{} : fmt::format("; did you mean \"{}\"?", nearest);
}

std::string quoted_list(const std::vector<std::string_view>& names) {
  std::string list;
  for (const std::string_view name : names)
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", name);
  return list;
}

}  // namespace tyndall
